// Lights as the kernels read them.
#pragma once

#include <vector>

#include "compile/flatten/flatten.hpp"

namespace csgrt {

/// One that shines everywhere, from a place.
inline kernel::LightRecord light_at(const Vec3& position, const Vec3& color) {
    const auto to_float = [](double x) { return static_cast<float>(x); };
    return {position.x,        position.y,        position.z,        1, 0, 0, -1, -1,
            to_float(color.x), to_float(color.y), to_float(color.z), 0};
}

/// `light` has a colour that is shaded (CompiledScene::shaded).
kernel::LightRecord light_record(const Light& light);

/// The lights of the regions that shine, by BRL-CAD's rules, and in each such region its brightness. `boxes`:
/// BRL-CAD's, one an instance. A region without a finite box gives none; a note says so.
void add_region_lights(FlatScene& flat, const std::vector<Box>& boxes, CompiledScene& compiled);

}  // namespace csgrt
