// What the reference asks of the kernels' geometry, in any precision.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/laboratory.hpp"
#include "compile/host_kernels.hpp"
#include "compile/lists/rows.hpp"
#include "reference/near_solids.hpp"
#include "reference/weave.hpp"

namespace csgrt {

class ReferenceKernels : public HostKernels {
public:
    /// In 113 bits it is the one in double: so that the two see the same rays.
    virtual Ray camera_ray(const kernel::Frame& frame, std::uint32_t x, std::uint32_t y) const;
    /// The ends of all segments along a ray, two a segment, by ascending solid. In double every solid is tried that is
    /// near, in single precision every one, in 113 bits, which are slow, those whose boxes are met. Segments that end
    /// before the frame's t_min are left out. Then what they weave, which is `weaver`'s.
    virtual std::span<const WovenPartition> trace(const kernel::Frame& frame, const kernel::RayRecord& ray,
                                                  const NearSolids& near, std::vector<kernel::End>& ends,
                                                  Weaver& weaver) const = 0;
    /// Adds a listed ray's rows (kernels/boolean/rows.h), and its partitions that overlap. `nodes` and `ends`: the
    /// ray's, as kernel 4 leaves them.
    virtual void append_rows(const kernel::Frame& frame, const kernel::RayRecord& ray,
                             const std::vector<kernel::End>& ends, const std::vector<kernel::PartitionNode>& nodes,
                             Fields fields, RowMemory& rows, std::vector<kernel::OverlapPiece>& pieces) const = 0;
    /// Which part of a picture's ray is seen, as it is compared with ends (kernels/traversal/view.h), and the sides
    /// that planes of the view take away (MISSED_...).
    struct Seen {
        double after, before;
        std::uint32_t beyond;
    };
    virtual Seen seen(const kernel::Frame& frame, const Ray& ray) const = 0;
    /// A pixel that shows a region's surface at an end; `leaves`: from within.
    virtual kernel::Pixel hit_pixel(const kernel::Frame& frame, const std::vector<kernel::LightRecord>& lights,
                                    std::uint32_t region, const kernel::MaterialRecord& material, const Ray& ray,
                                    const kernel::End& end, bool leaves) const = 0;
};

/// By the settings' precision and methods. `scene` must outlive the result. Precision::quad is on the host only.
std::unique_ptr<ReferenceKernels> make_kernels(const CompiledScene& scene, const Settings& settings = {});
/// The same for a reference, which computes with them: by the instructions that this processor has. The same bits.
std::unique_ptr<ReferenceKernels> make_kernels_to_run(const CompiledScene& scene, const Settings& settings = {});

std::unique_ptr<ReferenceKernels> make_double_kernels(const CompiledScene& scene, Quartic quartic);
std::unique_ptr<ReferenceKernels> make_fused_kernels(const CompiledScene& scene, Quartic quartic);
std::unique_ptr<ReferenceKernels> make_single_kernels(const CompiledScene& scene, Quartic quartic);
std::unique_ptr<ReferenceKernels> make_single_world_kernels(const CompiledScene& scene, Quartic quartic);
std::unique_ptr<ReferenceKernels> make_quad_kernels(const CompiledScene& scene, Quartic quartic);

}  // namespace csgrt
