// What the pipeline and the reference both hand back for a ray, and the public partitions made from it.
#pragma once

#include <vector>

#include "compile/host_kernels.hpp"

namespace csgrt {

/// A partition that at least one region claimed.
struct ClaimedPartition {
    kernel::End in, out;       ///< the ends that bound it; their t is the partition's
    bool in_leaves = false;    ///< `in` is where its solid ENDS (a subtraction exposes it): the normal is flipped
    bool out_enters = false;   ///< `out` is where its solid begins
    std::uint32_t region = 0;  ///< the lowest claimant
    std::vector<std::uint32_t> claimants;  ///< all of the region's rank, ascending; only kept if there are several
};

/// Joins neighbours of one region, leaves out what ends behind the ray's start, computes the normals, lists the
/// overlaps. `claims` in order of distance.
RayPartitions to_partitions(const HostKernels& kernels, const kernel::Frame& frame, const Ray& ray,
                            const std::vector<ClaimedPartition>& claims);

}  // namespace csgrt
