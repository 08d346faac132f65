// Regions -> their records, words, materials and boxes.
#pragma once

#include <cstdint>
#include <vector>

#include "compile/compiled_scene.hpp"
#include "compile/flatten/flatten.hpp"

namespace csgrt {

/// Takes the regions out of `flat`. `order`: the instances as solids are numbered; `brlcad_boxes`: one an instance.
void pack_regions(FlatScene& flat, const std::vector<std::uint32_t>& order, const std::vector<Box>& brlcad_boxes,
                  CompiledScene& compiled);

}  // namespace csgrt
