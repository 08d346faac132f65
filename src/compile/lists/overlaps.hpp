// Partitions that several regions of one rank claim -> rows of overlaps, with all claimants.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compile/compiled_scene.hpp"
#include "compile/lists/rows.hpp"

namespace csgrt {

/// What kernels 1 to 4 leave of a batch's rays, in double (kernels/shared/layout.h).
struct TracedBatch {
    std::vector<kernel::RayCount> offsets;  ///< one a ray and one behind
    std::vector<kernel::End> ends;
    std::vector<kernel::PartitionNode> nodes;
};

/// Where it stands.
struct TracedRays {
    const kernel::RayCount* offsets;  ///< one a ray and one behind
    const kernel::End* ends;
    const kernel::PartitionNode* nodes;
};

/// `pieces`: kernel 6's, by ray and by distance.
void append_overlaps(const CompiledScene& scene, std::span<const kernel::OverlapPiece> pieces, const TracedRays& traced,
                     RowMemory& rows);

/// The next one of a ray; it is joined with the one before where the same regions go on. `claimants`: ascending.
void append_overlap(std::uint32_t ray, double in, double out, std::span<const std::uint32_t> claimants,
                    RowMemory& rows);

}  // namespace csgrt
