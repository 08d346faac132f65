// Appearance: makes the materials, lights and background that the kernels read.
#pragma once

#include <span>
#include <vector>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// A light at a position, in all directions.
inline kernel::LightRecord light_at(const Vec3& position, const Vec3& color) {
    const auto to_float = [](double x) { return static_cast<float>(x); };
    return {position.x,        position.y,        position.z,        1, 0, 0, -1, -1,
            to_float(color.x), to_float(color.y), to_float(color.z), 0};
}

/// The appearance that a scene gives all of its regions.
struct SceneAppearance {
    std::span<const Light> lights;
    double ambient;
    Vec3 background;
};

/// The appearance of the scene and its regions. `shining` lists the regions that emit light, by BRL-CAD's rules. A
/// region of `shining` without a finite box gives no light, and a warning says so.
Appearance appearance_of(const SceneAppearance& scene, const SharedList<RegionInfo>& regions,
                         std::span<const RegionLight> shining, bool display_shading, std::vector<Warning>& warnings);

/// The same when only the scene's appearance and the `changed` regions differ from those of `before`. Warnings of
/// lights were given then.
Appearance appearance_of(const SceneAppearance& scene, const SharedList<RegionInfo>& regions,
                         std::span<const RegionLight> shining, const Appearance& before,
                         std::span<const std::uint32_t> changed);

}  // namespace csgrt
