// Materials, lights and background as the kernels read them.
#pragma once

#include <span>
#include <vector>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// One that shines everywhere, from a place.
inline kernel::LightRecord light_at(const Vec3& position, const Vec3& color) {
    const auto to_float = [](double x) { return static_cast<float>(x); };
    return {position.x,        position.y,        position.z,        1, 0, 0, -1, -1,
            to_float(color.x), to_float(color.y), to_float(color.z), 0};
}

/// What a scene gives all of its regions.
struct SceneLooks {
    std::span<const Light> lights;
    double ambient;
    Vec3 background;
};

/// Of the scene and its regions, by BRL-CAD's rules for those that shine, which are `shining`. A region that shines and
/// has no finite box gives no light, of which `warnings` tell.
Looks looks_of(const SceneLooks& scene, std::span<const RegionInfo> regions, std::span<const RegionLight> shining,
               bool display_shading, std::vector<Warning>& warnings);

}  // namespace csgrt
