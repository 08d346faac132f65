#include "compile/hash.hpp"

#include "base/fnv1a.hpp"

namespace csgrt {

std::uint64_t hash_of_geometry(const CompiledScene& scene) {
    Fnv1a hash;
    hash.add_all(scene.reals.get());
    hash.add_all(scene.planes.get());
    hash.add_all(scene.words.get());
    hash.add_all(scene.inner_nodes.get());
    hash.add_all(scene.nodes.get());
    hash.add_all(scene.solids.get());
    hash.add_all(scene.starts.get());
    hash.add_all(scene.trees.get());
    return hash.state();
}

std::uint64_t hash_of_material(std::size_t region, const kernel::MaterialRecord& material) {
    Fnv1a hash;
    hash.add(static_cast<std::uint64_t>(region));
    hash.add(material);
    return hash.state();
}

std::uint64_t hash_of(const CompiledScene& scene) {
    Fnv1a hash;
    hash.add(scene.geometry_hash);
    hash.add_all(scene.claims.get());
    hash.add(scene.materials_hash);
    hash.add(static_cast<std::uint64_t>(scene.lights.size()));
    for (const kernel::LightRecord& light : scene.lights) {
        // A record may end in padding, so its members are added one by one.
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
