#include "compile/hash.hpp"

#include <cstring>
#include <type_traits>

namespace csgrt {

namespace {

/// FNV-1a by words of 8 bytes, with the high bits of each product brought down: they would never reach the low ones.
class Fnv1a {
public:
    template <class T>
    void add(const T& value) {
        add_bytes(&value, sizeof(T));
        static_assert(std::is_trivially_copyable_v<T>);
    }
    template <class T>
    void add_all(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        add(static_cast<std::uint64_t>(values.size()));
        add_bytes(values.data(), values.size() * sizeof(T));
    }
    std::uint64_t state() const { return state_; }

private:
    void add_bytes(const void* data, std::size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (; size > 0; bytes += 8) {
            const std::size_t part = size < 8 ? size : 8;
            std::uint64_t word = 0;
            std::memcpy(&word, bytes, part);
            state_ = (state_ ^ word) * 1099511628211u;
            state_ ^= state_ >> 32;
            size -= part;
        }
    }

    std::uint64_t state_ = 14695981039346656037u;
};

}  // namespace

std::uint64_t hash_of_geometry(const CompiledScene& scene) {
    Fnv1a hash;
    hash.add_all(scene.reals);
    hash.add_all(scene.planes);
    hash.add_all(scene.plane_refs);
    hash.add_all(scene.words);
    hash.add_all(scene.inner_nodes);
    hash.add_all(scene.nodes);
    return hash.state();
}

std::uint64_t hash_of(const CompiledScene& scene, std::uint64_t geometry) {
    Fnv1a hash;
    hash.add(geometry);
    hash.add_all(scene.solids);
    hash.add_all(scene.starts);
    hash.add_all(scene.leaves);
    hash.add_all(scene.regions);
    hash.add_all(scene.trees);
    hash.add_all(scene.materials);
    hash.add(static_cast<std::uint64_t>(scene.lights.size()));
    for (const kernel::LightRecord& light : scene.lights) {
        // Field by field: a record may end in padding.
        for (const double x : {light.x, light.y, light.z, light.w, light.bx, light.by, light.bz, light.cosine}) hash.add(x);
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
