// Reference kernels: the functions of the kernels' geometry that the reference needs, in any precision.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/laboratory.hpp"
#include "compile/compiled_scene.hpp"
#include "rays/rows.hpp"
#include "reference/near_solids.hpp"
#include "reference/weave.hpp"

namespace csgrt {

/// The interface to the kernels' functions that the reference calls, for all precisions.
class ReferenceKernels {
public:
    virtual ~ReferenceKernels() = default;

    /// Throws Error (usage) for a ray whose numbers do not fit the precision. `number`: the ray's index in the list.
    virtual void check(const kernel::RayRecord& ray, std::uint64_t number) const = 0;
    /// The ray of a pixel. In 113 bits it is the ray in double, so that the two precisions see the same rays.
    virtual Ray camera_ray(const kernel::Frame& frame, std::uint32_t x, std::uint32_t y) const;
    /// Finds the boundaries of all segments along a ray, two a segment, by ascending solid, and weaves them; the result
    /// refers to the memory of `weaver`. In double every near solid is tried, in single precision every solid. In 113
    /// bits, which are slow, the solids whose boxes are met are tried. Segments that end before the frame's t_min are
    /// left out.
    virtual std::span<const WovenPartition> trace(const kernel::Frame& frame, const kernel::RayRecord& ray,
                                                  const NearSolids& near, std::vector<kernel::Boundary>& boundaries,
                                                  Weaver& weaver) const = 0;
    /// Adds a listed ray's rows (kernels/boolean/rows.h), and its partitions that overlap. `nodes` and `boundaries`:
    /// the ray's results after kernel 4.
    virtual void append_rows(const kernel::Frame& frame, const kernel::RayRecord& ray,
                             const std::vector<kernel::Boundary>& boundaries,
                             const std::vector<kernel::PartitionNode>& nodes, Fields fields, RowMemory& rows,
                             std::vector<kernel::OverlapRecord>& overlap_records) const = 0;
    /// The visible range of a picture's ray, in the form that is compared with boundaries (kernels/traversal/view.h),
    /// and the sides that planes of the view cut away (MISSED_...).
    struct Seen {
        double after, before;
        std::uint32_t beyond;
    };
    virtual Seen seen(const kernel::Frame& frame, const Ray& ray) const = 0;
    /// A pixel that shows a region's surface at a boundary; `leaves`: the surface is seen from within.
    virtual kernel::Pixel hit_pixel(const kernel::Frame& frame, const std::vector<kernel::LightRecord>& lights,
                                    std::uint32_t region, const kernel::MaterialRecord& material, const Ray& ray,
                                    const kernel::Boundary& end, bool leaves) const = 0;
};

/// Makes the kernels for the settings' precision and methods. `scene` must outlive the result. Precision::quad is on
/// the host only.
std::unique_ptr<ReferenceKernels> make_kernels(const CompiledScene& scene, const Settings& settings = {});
/// Makes the kernels for a reference, compiled for the instructions of this processor. The bits are the same.
std::unique_ptr<ReferenceKernels> make_kernels_to_run(const CompiledScene& scene, const Settings& settings = {});

std::unique_ptr<ReferenceKernels> make_double_kernels(const CompiledScene& scene, Quartic quartic);
std::unique_ptr<ReferenceKernels> make_fused_kernels(const CompiledScene& scene, Quartic quartic);
std::unique_ptr<ReferenceKernels> make_single_kernels(const CompiledScene& scene, Quartic quartic);
std::unique_ptr<ReferenceKernels> make_single_world_kernels(const CompiledScene& scene, Quartic quartic);
std::unique_ptr<ReferenceKernels> make_quad_kernels(const CompiledScene& scene, Quartic quartic);

}  // namespace csgrt
