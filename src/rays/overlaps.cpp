#include "rays/overlaps.hpp"

#include <algorithm>
#include <utility>

#include "kernel_host/geometry.hpp"

namespace csgrt {
namespace kernel {
#define CSGRT_LARGE_TERMS
#include "../kernels/boolean/claimants.h"
}  // namespace kernel

namespace {

/// The claimants of the partition that begins at `in`. Weaving gives all boundaries of an event the same distance.
std::span<const std::uint32_t> claimants_of(const CompiledScene& scene, const kernel::Boundary* boundaries,
                                            std::uint32_t segments, double in, std::vector<std::uint32_t>& found) {
    std::vector<std::uint32_t> bits(kernel::words_of(segments));
    for (std::uint32_t segment = 0; segment < segments; ++segment)
        if (boundaries[2 * segment].t <= in && in < boundaries[2 * segment + 1].t)
            bits[segment / 32] |= 1u << segment % 32;
    const kernel::cover cover{boundaries,          bits.data(),         segments,          0, 1, 0,
                              scene.solids.data(), scene.starts.data(), scene.trees.data()};
    found.resize(kernel::claims_at_most(cover));
    return {found.data(), kernel::all_claimants(cover, scene.rank_ends, found.data())};
}

}  // namespace

void append_overlaps(const CompiledScene& scene, std::span<const kernel::OverlapRecord> overlap_records,
                     const TracedRays& traced, RowMemory& rows) {
    std::vector<std::uint32_t> found;
    for (const kernel::OverlapRecord& overlap_record : overlap_records) {
        const std::uint32_t first = traced.offsets[overlap_record.ray].segments,
                            segments = traced.offsets[overlap_record.ray + 1].segments - first;
        const kernel::Boundary* const boundaries = traced.boundaries + 2 * std::size_t{first};
        const kernel::PartitionNode& node = traced.nodes[2 * std::size_t{first} + overlap_record.node];
        append_overlap(overlap_record.ray, overlap_record.in, overlap_record.out,
                       claimants_of(scene, boundaries, segments, boundaries[node.in_boundary].t, found), rows);
    }
}

void append_overlap(std::uint32_t ray, double in, double out, std::span<const std::uint32_t> claimants,
                    RowMemory& rows) {
    std::vector<std::int32_t>& regions = rows.overlap_regions;
    if (!rows.overlaps.empty()) {
        OverlapRow& last = rows.overlaps.back();
        if (last.ray == ray && last.out == in &&
            std::equal(regions.begin() + static_cast<std::ptrdiff_t>(last.first_region), regions.end(),
                       claimants.begin(), claimants.end(), std::cmp_equal<std::int32_t, std::uint32_t>)) {
            last.out = out;
            return;
        }
    }
    rows.overlaps.push_back({in, out, ray, regions.size()});
    regions.insert(regions.end(), claimants.begin(), claimants.end());
}

}  // namespace csgrt
