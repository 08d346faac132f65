// What the exact way leaves on the device -> each ray's claimed partitions, on the host.
#include <algorithm>
#include <iterator>
#include <utility>

#include "kernel_host/geometry.hpp"
#include "pipeline/passes/partitions.hpp"

namespace csgrt {
namespace kernel {
#define CSGRT_LARGE_TERMS
#include "../kernels/boolean/claim.h"
}  // namespace kernel

std::vector<std::vector<ClaimedPartition>> Exact::claims(std::uint32_t rays) const {
    const auto offsets = counts_.read<kernel::RayCount>(std::size_t{rays} + 1);
    const auto ends = kernels_.ends(ends_.read<std::byte>(2 * std::size_t{total_.segments} * kernels_.end_bytes()));
    const auto nodes = found_.read<kernel::PartitionNode>(2 * std::size_t{total_.segments});
    const auto bits = bits_.read<std::uint32_t>(total_.words);
    std::vector<std::vector<ClaimedPartition>> claims(rays);
    for (std::uint32_t i = 0; i < rays; ++i)
        claims[i] = claims_of(ends, nodes, bits, offsets[i], offsets[i + 1]);
    return claims;
}

namespace {

/// All regions that claim what `cover` covers and are of the first one's rank, ascending.
std::vector<std::uint32_t> claimants_of(const CompiledScene& scene, const kernel::cover& cover) {
    kernel::covered_solids covered;
    kernel::list_covered(cover, &covered);
    std::vector<std::uint32_t> claimants;
    for (std::uint32_t segment = 0; segment < cover.segments; ++segment) {
        if (!kernel::covers(cover, segment)) continue;
        const kernel::SolidRecord& solid = scene.solids[cover.ends[2 * segment].solid];
        for (std::uint32_t i = 0; i < solid.start_count; ++i) {
            const kernel::StartRecord& start = scene.starts[solid.first_start + i];
            if (kernel::term_holds(cover, &covered, start)) claimants.push_back(start.region);
        }
    }
    std::sort(claimants.begin(), claimants.end());
    claimants.erase(std::unique(claimants.begin(), claimants.end()), claimants.end());
    std::erase_if(claimants, [&, first = claimants.empty() ? NONE : claimants.front()](std::uint32_t region) {
        return !kernel::same_rank(scene.rank_ends, first, region);
    });
    return claimants;
}

}  // namespace

// Found again on the host, only for the few partitions that regions overlap in: on one side at least of a contact.
std::vector<std::uint32_t> Exact::claimants(const kernel::End* ends, std::uint32_t segments,
                                            const std::uint32_t* bits) const {
    kernel::cover cover{ends,
                        bits,
                        segments,
                        0,
                        1,
                        scene_.solids.data(),
                        scene_.starts.data(),
                        scene_.leaves.data(),
                        scene_.trees.data()};
    std::vector<std::uint32_t> all;
    for (const std::uint32_t missed : {MISSED_ABOVE, MISSED_BELOW}) {
        cover.missed = missed;
        const std::vector<std::uint32_t> side = claimants_of(scene_, cover);
        std::vector<std::uint32_t> either;
        if (side.size() > 1) std::set_union(all.begin(), all.end(), side.begin(), side.end(), std::back_inserter(either));
        if (side.size() > 1) all = std::move(either);
    }
    return all;
}

std::vector<ClaimedPartition> Exact::claims_of(const std::vector<kernel::End>& ends,
                                               const std::vector<kernel::PartitionNode>& nodes,
                                               const std::vector<std::uint32_t>& bits, const kernel::RayCount& begin,
                                               const kernel::RayCount& end) const {
    std::vector<ClaimedPartition> claims;
    const std::uint32_t segments = end.segments - begin.segments;
    const std::size_t base = 2 * std::size_t{begin.segments};
    for (std::uint32_t node = kernel::first_partition(nodes.data() + base, segments); node != NONE; node = nodes[base + node].next) {
        const kernel::PartitionNode& partition = nodes[base + node];
        const std::uint32_t region = partition.owner & ~OVERLAP;
        if (region == NONE) continue;
        ClaimedPartition claim;
        claim.in = ends[base + partition.in_end];
        claim.out = ends[base + partition.out_end];
        claim.in_leaves = partition.in_end % 2 == 1;
        claim.out_enters = partition.out_end % 2 == 0;
        claim.region = region;
        if (partition.owner & OVERLAP)
            claim.claimants =
                claimants(ends.data() + base, segments, bits.data() + begin.words + node * kernel::words_of(segments));
        claims.push_back(std::move(claim));
    }
    return claims;
}

}  // namespace csgrt
