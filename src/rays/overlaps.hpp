// Overlaps: makes rows for the partitions that several regions of one rank claim, with all claimants.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compile/compiled_scene.hpp"
#include "rays/rows.hpp"

namespace csgrt {

/// The results of kernels 1 to 4 for a batch's rays, in double (kernels/shared/layout.h).
struct TracedBatch {
    std::vector<kernel::RayCount> offsets;  ///< one a ray, and one more
    std::vector<kernel::Boundary> boundaries;
    std::vector<kernel::PartitionNode> nodes;
};

/// Pointers to the results of a TracedBatch.
struct TracedRays {
    const kernel::RayCount* offsets;  ///< one a ray, and one more
    const kernel::Boundary* boundaries;
    const kernel::PartitionNode* nodes;
};

/// Appends the overlaps of a batch. `overlap_records`: kernel 6's records, by ray and by distance.
void append_overlaps(const CompiledScene& scene, std::span<const kernel::OverlapRecord> overlap_records,
                     const TracedRays& traced, RowMemory& rows);

/// Appends the next overlap of a ray. It is joined with the previous overlap if this touches it and has the same
/// claimants. `claimants`: ascending.
void append_overlap(std::uint32_t ray, double in, double out, std::span<const std::uint32_t> claimants,
                    RowMemory& rows);

}  // namespace csgrt
