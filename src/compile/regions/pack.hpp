// Packing regions: makes their words, terms and boxes.
#pragma once

#include <cstdint>
#include <vector>

#include "compile/compiled_scene.hpp"
#include "compile/flatten/flatten.hpp"

namespace csgrt {

/// The packed regions of a scene: their terms and trees, and the solids' records with the data of terms.
struct PackedRegions {
    Logic logic;
    std::vector<kernel::SolidRecord> solids;  ///< see list_terms
};

/// Packs the regions. `order`: the instances in the order of the solids' numbers; `brlcad_boxes`: one an instance;
/// `trees`: the trees from which terms are made, see Clipped.
PackedRegions pack_regions(const FlatScene& flat, const std::vector<FlatTree>& trees,
                           const std::vector<std::uint32_t>& order, const std::vector<Box>& brlcad_boxes);

}  // namespace csgrt
