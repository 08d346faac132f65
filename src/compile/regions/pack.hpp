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

/// Takes the infos out of the regions, and sets their bounds, and `bounds` around all. `brlcad_boxes`: one an instance.
SharedList<RegionInfo> take_infos(FlatScene& flat, const std::vector<Box>& brlcad_boxes, Box& bounds);
/// The box around all regions' bounds.
Box bounds_of(const SharedList<RegionInfo>& regions);

/// Packs the regions, but for Logic::bounds. `order`: the instances in the order of the solids' numbers; `trees`: the
/// trees from which terms are made, see Clipped. `infos`: the result of take_infos().
PackedRegions pack_regions(const FlatScene& flat, const std::vector<FlatTree>& trees,
                           const std::vector<std::uint32_t>& order, const std::vector<Box>& brlcad_boxes,
                           SharedList<RegionInfo> infos);

}  // namespace csgrt
