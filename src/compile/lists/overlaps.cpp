#include "compile/lists/overlaps.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "kernel_host/geometry.hpp"

namespace csgrt {
namespace kernel {
#define CSGRT_LARGE_TERMS
#include "../kernels/boolean/claim.h"
}  // namespace kernel

namespace {

/// All regions that claim what `cover` covers and are of the first one's rank, ascending.
std::vector<std::uint32_t> claimants_of(const CompiledScene& scene, const kernel::cover& cover) {
    kernel::covered_solids covered;
    kernel::list_covered(cover, &covered);
    std::vector<std::uint32_t> claimants;
    std::uint32_t known = NONE;  // the term that was looked at last: several solids may start it
    for (std::uint32_t segment = 0; segment < cover.segments; ++segment) {
        if (!kernel::covers(cover, segment)) continue;
        const kernel::SolidRecord& solid = scene.solids[cover.ends[2 * segment].solid];
        for (std::uint32_t i = 0; i < solid.start_count; ++i) {
            const kernel::StartRecord& start = scene.starts[solid.first_start + i];
            if (start.first_word != std::exchange(known, start.first_word) &&
                kernel::term_holds(cover, &covered, start))
                claimants.push_back(start.region);
        }
    }
    std::sort(claimants.begin(), claimants.end());
    claimants.erase(std::unique(claimants.begin(), claimants.end()), claimants.end());
    std::erase_if(claimants, [&, first = claimants.empty() ? NONE : claimants.front()](std::uint32_t region) {
        return !kernel::same_rank(scene.rank_ends, first, region);
    });
    return claimants;
}

/// The same for a partition that several regions claim, which are found again on the host: on one side at least of a
/// contact. `in`: where it begins. Weaving has given all ends of an event the same distance.
std::vector<std::uint32_t> all_claimants(const CompiledScene& scene, const kernel::End* ends, std::uint32_t segments,
                                         double in) {
    std::vector<std::uint32_t> bits(kernel::words_of(segments));
    for (std::uint32_t segment = 0; segment < segments; ++segment)
        if (ends[2 * segment].t <= in && in < ends[2 * segment + 1].t) bits[segment / 32] |= 1u << segment % 32;
    kernel::cover cover{
        ends, bits.data(), segments, 0, 1, scene.solids.data(), scene.starts.data(), scene.trees.data()};
    std::vector<std::uint32_t> all;
    for (const std::uint32_t missed : {MISSED_ABOVE, MISSED_BELOW}) {
        cover.missed = missed;
        const std::vector<std::uint32_t> side = claimants_of(scene, cover);
        if (side.size() < 2) continue;
        std::vector<std::uint32_t> either;
        std::set_union(all.begin(), all.end(), side.begin(), side.end(), std::back_inserter(either));
        all = std::move(either);
    }
    return all;
}

}  // namespace

void append_overlaps(const CompiledScene& scene, std::span<const kernel::OverlapPiece> pieces, const TracedRays& traced,
                     RowMemory& rows) {
    for (const kernel::OverlapPiece& piece : pieces) {
        const std::uint32_t first = traced.offsets[piece.ray].segments,
                            segments = traced.offsets[piece.ray + 1].segments - first;
        const kernel::End* const ends = traced.ends + 2 * std::size_t{first};
        const kernel::PartitionNode& node = traced.nodes[2 * std::size_t{first} + piece.node];
        const std::vector<std::uint32_t> all = all_claimants(scene, ends, segments, ends[node.in_end].t);
        append_overlap(piece.ray, piece.in, piece.out, all, rows);
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
