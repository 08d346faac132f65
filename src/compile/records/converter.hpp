// Record converter: converts a compiled scene, frames and rays to the bytes that a device's kernels read, in the
// kernels' precision. It converts the kernels' results back to records in double.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <csgrt/settings.hpp>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// The converter of records for one precision. There is an implementation for each precision: double, single, and
/// single in the world's coordinates.
class RecordConverter {
public:
    virtual ~RecordConverter() = default;

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

/// Makes a converter by the settings' precision. `scene` must outlive the result.
std::unique_ptr<RecordConverter> make_converter(const CompiledScene& scene, const Settings& settings = {});

std::unique_ptr<RecordConverter> make_double_converter(const CompiledScene& scene);
std::unique_ptr<RecordConverter> make_single_converter(const CompiledScene& scene);
std::unique_ptr<RecordConverter> make_single_world_converter(const CompiledScene& scene);

}  // namespace csgrt
