#include "compile/hash.hpp"

#include <type_traits>

namespace csgrt {

namespace {

class Fnv1a {
public:
    template <class T>
    void add(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
        for (std::size_t i = 0; i < sizeof(T); ++i) state_ = (state_ ^ bytes[i]) * 1099511628211u;
    }
    template <class T>
    void add_all(const std::vector<T>& values) {
        add(static_cast<std::uint64_t>(values.size()));
        for (const T& value : values) add(value);
    }
    std::uint64_t state() const { return state_; }

private:
    std::uint64_t state_ = 14695981039346656037u;
};

}  // namespace

std::uint64_t hash_of(const CompiledScene& scene) {
    Fnv1a hash;
    hash.add_all(scene.solids);
    hash.add_all(scene.reals);
    hash.add_all(scene.planes);
    hash.add_all(scene.plane_refs);
    hash.add_all(scene.words);
    hash.add_all(scene.inner_nodes);
    hash.add_all(scene.starts);
    hash.add_all(scene.leaves);
    hash.add_all(scene.regions);
    hash.add_all(scene.trees);
    hash.add_all(scene.materials);
    hash.add(static_cast<std::uint64_t>(scene.lights.size()));
    for (const kernel::LightRecord& light : scene.lights) {
        // Field by field: the record ends in padding.
        for (const double position : {light.x, light.y, light.z}) hash.add(position);
        for (const float color : {light.r, light.g, light.b}) hash.add(color);
    }
    hash.add_all(scene.nodes);
    hash.add(scene.unbounded_count);
    for (const double value :
         {scene.center.x, scene.center.y, scene.center.z, scene.radius, scene.ambient, scene.tolerance})
        hash.add(value);
    hash.add_all(scene.background);
    return hash.state();
}

}  // namespace csgrt
