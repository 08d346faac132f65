// Reference: traces rays on the CPU to check devices, bit by bit. It tries every solid near the ray, and evaluates the
// trees as the model gives them.
#pragma once

#include <cstdint>
#include <vector>

#include "base/watch.hpp"
#include "compile/frame.hpp"
#include "rays/list.hpp"
#include "rays/row_receivers.hpp"
#include "reference/reference_kernels.hpp"

namespace csgrt {

/// Counts of a call, as Statistics has them.
struct ReferenceCounts {
    std::uint64_t ends = 0, segments = 0, partitions = 0, overlaps = 0;
};

/// The reference for the pipeline: it finds the same partitions by other methods. It shares the geometry with the
/// kernels, but not the walk, the weave and the evaluation.
class Reference {
public:
    /// Refers to the two arguments, which must outlive the reference.
    Reference(const CompiledScene& scene, const ReferenceKernels& kernels);

    /// Renders the pixels row by row from the top left, or only the pixels with the numbers `some`. Throws Error
    /// (interrupted) if `watch`, which may be null, ends the work.
    std::vector<kernel::Pixel> render(const PreparedFrame& prepared, Watch* watch, ReferenceCounts& counts,
                                      const std::vector<std::uint32_t>* some = nullptr) const;
    /// Traces every ray of a list, and puts the rows into the receiver.
    void trace(const kernel::Frame& frame, const RayList& rays, RowReceiver& receiver, Watch* watch,
               ReferenceCounts& counts) const;

private:
    struct RayAnswer;
    /// Does the ray run in a face of one of the partition's solids?
    static bool in_contact(const WovenPartition& partition, const std::vector<kernel::Boundary>& boundaries);
    static bool is_one_solid(const WovenPartition& partition, const std::vector<kernel::Boundary>& boundaries);
    /// The regions of the first rank that claim a partition, ascending. Solids whose boundaries have any of the marks
    /// `missed` do not count.
    void find_claimants(const WovenPartition& partition, std::uint32_t missed, RayAnswer& answer,
                        std::vector<std::uint32_t>& claimants) const;
    /// The claimants of a partition in which the ray runs in a face, by the rule of contact (kernels/boolean/claim.h).
    /// `beyond`: sides that are cut away.
    void find_beside(const WovenPartition& partition, std::uint32_t beyond, RayAnswer& answer) const;
    void evaluate(const kernel::Frame& frame, const kernel::RayRecord& ray, RayAnswer& answer) const;
    /// Adds a listed ray's rows, and rows of overlaps.
    void append_rows(const kernel::Frame& frame, const kernel::RayRecord& record, std::uint32_t ray, Fields fields,
                     RayAnswer& answer, RowMemory& rows) const;
    bool inside(std::uint32_t region, const std::vector<std::uint32_t>& solids,
                std::vector<std::uint8_t>& values) const;
    template <class Work>
    void parallel(std::size_t count, Watch* watch, const Work& work) const;

    const CompiledScene& scene_;
    const ReferenceKernels& kernels_;
    NearSolids near_;
    std::vector<std::vector<std::uint32_t>> regions_of_;  ///< by solid, found from the trees by the reference itself
};

}  // namespace csgrt
