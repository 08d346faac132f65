#include "compile/hash.hpp"

#include "base/fnv1a.hpp"

namespace csgrt {

/// Of what is large.
static std::uint64_t hash_of_geometry(const CompiledScene& scene) {
    Fnv1a hash;
    hash.add_all(scene.reals);
    hash.add_all(scene.planes);
    hash.add_all(scene.words);
    hash.add_all(scene.inner_nodes);
    hash.add_all(scene.nodes);
    return hash.state();
}

std::uint64_t hash_of(const CompiledScene& scene) {
    Fnv1a hash;
    hash.add(hash_of_geometry(scene));
    hash.add_all(scene.solids);
    hash.add_all(scene.starts);
    hash.add_all(scene.trees);
    hash.add_all(scene.materials);
    hash.add(static_cast<std::uint64_t>(scene.lights.size()));
    for (const kernel::LightRecord& light : scene.lights) {
        // Field by field: a record may end in padding.
        for (const double x : {light.x, light.y, light.z, light.w, light.bx, light.by, light.bz, light.cosine})
            hash.add(x);
        for (const float color : {light.r, light.g, light.b}) hash.add(color);
        hash.add(light.beam);
    }
    hash.add(scene.unbounded_count);
    for (const double value :
         {scene.center.x, scene.center.y, scene.center.z, scene.radius, scene.ambient, scene.tolerance})
        hash.add(value);
    hash.add_all(scene.background);
    return hash.state();
}

}  // namespace csgrt
