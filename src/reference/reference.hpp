// The CPU reference: every solid near the ray tried, unique lists, trees as the model gives them. It checks the device,
// bit by bit.
#pragma once

#include <cstdint>
#include <vector>

#include "base/watch.hpp"
#include "compile/lists/ray_list.hpp"
#include "compile/lists/sink.hpp"
#include "compile/frame.hpp"
#include "reference/reference_kernels.hpp"

namespace csgrt {

struct ReferenceCounts {
    std::uint64_t ends = 0, segments = 0, partitions = 0, overlaps = 0;
};

class Reference {
public:
    /// Both must outlive it.
    Reference(const CompiledScene& scene, const ReferenceKernels& kernels);

    /// Pixels by row from the top left, or those with the numbers `some`. Throws Error (interrupted) if `watch`, which
    /// may be null, says so.
    std::vector<kernel::Pixel> render(const PreparedFrame& prepared, Watch* watch, ReferenceCounts& counts,
                                      const std::vector<std::uint32_t>* some = nullptr) const;
    /// Every ray of a list.
    void trace(const kernel::Frame& frame, const RayList& rays, RowTaker& sink, Watch* watch,
               ReferenceCounts& counts) const;

private:
    struct Claims;
    /// Does the ray run in a face of one of its solids?
    static bool in_contact(const WovenPartition& partition, const std::vector<kernel::End>& ends);
    static bool is_one_solid(const WovenPartition& partition, const std::vector<kernel::End>& ends);
    /// The regions of the first rank that claim a partition, ascending, by its solids but those whose ends have any of
    /// `missed`.
    void find_claimants(const WovenPartition& partition, std::uint32_t missed, Claims& claims,
                        std::vector<std::uint32_t>& claimants) const;
    /// The claimants of a partition in which the ray runs in a face, by the rule of contact (kernels/boolean/claim.h).
    /// `beyond`: sides that are not asked for.
    void find_beside(const WovenPartition& partition, std::uint32_t beyond, Claims& claims) const;
    void evaluate(const kernel::Frame& frame, const kernel::RayRecord& ray, Claims& claims) const;
    /// Adds a listed ray's rows, and rows of overlaps.
    void append_rows(const kernel::Frame& frame, const kernel::RayRecord& record, std::uint32_t ray, Fields fields,
                     Claims& claims, RowMemory& rows) const;
    bool inside(std::uint32_t region, const std::vector<std::uint32_t>& solids,
                std::vector<std::uint8_t>& values) const;
    template <class Work>
    void parallel(std::size_t count, Watch* watch, const Work& work) const;

    const CompiledScene& scene_;
    const ReferenceKernels& kernels_;
    NearSolids near_;
    std::vector<std::vector<std::uint32_t>> regions_of_;  ///< by solid, found from the trees here
};

}  // namespace csgrt
