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

/// The results of kernels 2 and 3 for some rays of a batch, in double.
struct SomeRays {
    struct Place {
        std::uint32_t ray, segments;
        std::size_t first;  ///< the first segment's number in the lists
    };
    std::vector<Place> rays = {};                  ///< ascending
    const kernel::Boundary* boundaries = nullptr;  ///< two a segment
    const kernel::PartitionNode* nodes = nullptr;  ///< two a segment
};

/// Appends the overlaps of a batch. `overlap_records`: kernel 6's records, by ray and by distance.
void append_overlaps(const CompiledScene& scene, std::span<const kernel::OverlapRecord> overlap_records,
                     const TracedRays& traced, RowMemory& rows);

/// The overlaps of a batch as kernel 6 gives them, one a record, by ray and by distance.
struct ListedOverlaps {
    std::span<const kernel::OverlapRecord> records;
    const kernel::RayCount* places;  ///< of a record's first claimant, in `segments`
    const std::uint32_t* claimants;  ///< ascending
    const std::uint32_t* counts;     ///< of claimants
    const SomeRays& deep;            ///< all deep rays, whose claimants are not listed
};
/// Replaces the overlaps in `rows`, by several threads if there are many.
void take_overlaps(const CompiledScene& scene, const ListedOverlaps& listed, RowMemory& rows);

/// Appends the next overlap of a ray. It is joined with the previous overlap if this touches it and has the same
/// claimants. `claimants`: ascending.
void append_overlap(std::uint32_t ray, double in, double out, std::span<const std::uint32_t> claimants,
                    RowMemory& rows);

}  // namespace csgrt
