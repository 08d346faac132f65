// What kernels 1 to 4 leave of a batch's rays, on the host -> each ray's claimed partitions.
#pragma once

#include <cstdint>
#include <vector>

#include "compile/compiled_scene.hpp"
#include "compile/regions/claims.hpp"

namespace csgrt {

/// The buffers of kernels/shared/layout.h as they stand after kernel 4, in double.
struct TracedPartitions {
    std::vector<kernel::RayCount> offsets;  ///< one a ray and one behind
    std::vector<kernel::End> ends;
    std::vector<kernel::PartitionNode> nodes;
};

/// The claimed partitions of one of the rays, in order along it, each with all regions that claim it if several do.
std::vector<ClaimedPartition> claimed_partitions(const CompiledScene& scene, const TracedPartitions& traced,
                                                 std::size_t ray);

}  // namespace csgrt
