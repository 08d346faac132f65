// A compiled scene in one precision: the tables as that precision's kernels read them, and the kernels' geometry on the
// host. On this side everything stays in double; what crosses the bus is bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "compiled_scene.hpp"

namespace csgrt {

class HostKernels {
public:
    virtual ~HostKernels() = default;

    /// The scene's tables that depend on the precision. They live as long as the compiled scene and this.
    struct Tables {
        std::span<const std::byte> solids, reals, planes, inner_nodes, nodes;
    };
    virtual Tables tables() const = 0;
    virtual std::vector<std::byte> frame(const kernel::Frame& frame) const = 0;
    virtual std::vector<std::byte> lights(const std::vector<kernel::LightRecord>& lights) const = 0;
    /// Throws Error (usage) for a ray whose numbers do not fit the precision.
    virtual void check(const std::vector<Ray>& rays) const = 0;
    virtual std::vector<std::byte> rays(std::span<const Ray> rays) const = 0;
    virtual std::size_t ray_bytes() const = 0;
    virtual std::size_t end_bytes() const = 0;
    virtual std::vector<kernel::End> ends(const std::vector<std::byte>& bytes) const = 0;

    /// Where along the ray as it was given an end lies whose t is the kernels'.
    virtual double distance(const kernel::Frame& frame, const Ray& ray, double t) const = 0;
    /// The outward unit normal of its solid at an end.
    virtual Vec3 normal(const kernel::Frame& frame, const Ray& ray, const kernel::End& end) const = 0;
};

}  // namespace csgrt
