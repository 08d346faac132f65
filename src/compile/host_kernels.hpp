// Host kernels: a compiled scene in one precision. They have the tables as that precision's kernels read them, and the
// kernels' geometry on the host. Callers stay in double; the bytes for the bus are converted here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "compiled_scene.hpp"

namespace csgrt {

/// The kernels of one precision as the host sees them. Each precision (double, single, single in the world's
/// coordinates, 113 bits) is one implementation, made of the same kernel sources. Devices use it to convert tables,
/// frames and rays to bytes, and results back to double.
class HostKernels {
public:
    virtual ~HostKernels() = default;

    /// The scene's tables that depend on the precision. They live as long as the compiled scene and this object.
    struct Tables {
        std::span<const std::byte> solids, reals, planes, inner_nodes, nodes;
    };
    virtual Tables tables() const = 0;
    virtual std::vector<std::byte> frame(const kernel::Frame& frame) const = 0;
    virtual std::vector<std::byte> lights(const std::vector<kernel::LightRecord>& lights) const = 0;
    /// Throws Error (usage) for a ray whose numbers do not fit the precision. `first`: the index of the first ray.
    virtual void check(std::span<const kernel::RayRecord> rays, std::uint64_t first) const = 0;
    /// Writes ray_bytes() for each ray, from `to` on. Any thread.
    virtual void write_rays(std::span<const kernel::RayRecord> rays, std::byte* to) const = 0;
    std::vector<std::byte> rays(std::span<const kernel::RayRecord> rays) const {
        std::vector<std::byte> bytes(rays.size() * ray_bytes());
        write_rays(rays, bytes.data());
        return bytes;
    }
    virtual std::size_t ray_bytes() const = 0;
    virtual std::size_t boundary_bytes() const = 0;
    virtual std::size_t overlap_bytes() const = 0;
    virtual std::size_t wide_bytes() const = 0;
    virtual std::vector<kernel::Boundary> boundaries(const std::vector<std::byte>& bytes) const = 0;
    virtual std::vector<kernel::OverlapRecord> overlap_records(const std::vector<std::byte>& bytes) const = 0;
};

}  // namespace csgrt
