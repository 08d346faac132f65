#include "rays/overlaps.hpp"

#include <algorithm>
#include <utility>

#include "base/parallel.hpp"
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

/// Finds an overlap's claimants among its ray's segments, and appends it.
void append_evaluated(const CompiledScene& scene, const kernel::OverlapRecord& overlap_record,
                      const kernel::Boundary* boundaries, const kernel::PartitionNode* nodes, std::uint32_t segments,
                      std::vector<std::uint32_t>& found, RowMemory& rows) {
    const double in = boundaries[nodes[overlap_record.node].in_boundary].t;
    append_overlap(overlap_record.ray, overlap_record.in, overlap_record.out,
                   claimants_of(scene, boundaries, segments, in, found), rows);
}

void append_listed(const CompiledScene& scene, const ListedOverlaps& listed, std::size_t first, std::size_t end,
                   RowMemory& rows) {
    std::vector<std::uint32_t> found;
    rows.overlaps.reserve(end - first);
    rows.overlap_regions.reserve(2 * (end - first));
    for (std::size_t i = first; i < end; ++i) {
        const kernel::OverlapRecord& record = listed.records[i];
        const auto deep = std::ranges::lower_bound(listed.deep.rays, record.ray, {}, &SomeRays::Place::ray);
        if (deep == listed.deep.rays.end() || deep->ray != record.ray)
            append_overlap(record.ray, record.in, record.out,
                           {listed.claimants + listed.places[i].segments, listed.counts[i]}, rows);
        else
            append_evaluated(scene, record, listed.deep.boundaries + 2 * deep->first,
                             listed.deep.nodes + 2 * deep->first, deep->segments, found, rows);
    }
}

}  // namespace

void append_overlaps(const CompiledScene& scene, std::span<const kernel::OverlapRecord> overlap_records,
                     const TracedRays& traced, RowMemory& rows) {
    std::vector<std::uint32_t> found;
    for (const kernel::OverlapRecord& overlap_record : overlap_records) {
        const std::size_t first = traced.offsets[overlap_record.ray].segments;
        const auto segments = static_cast<std::uint32_t>(traced.offsets[overlap_record.ray + 1].segments - first);
        append_evaluated(scene, overlap_record, traced.boundaries + 2 * first, traced.nodes + 2 * first, segments,
                         found, rows);
    }
}

// Overlaps of one ray may be joined, so each thread takes whole rays.
void take_overlaps(const CompiledScene& scene, const ListedOverlaps& listed, RowMemory& rows) {
    constexpr std::size_t part = 1 << 12;
    const std::size_t count = listed.records.size();
    const auto ray_begin = [&](std::size_t i) {
        while (i > 0 && i < count && listed.records[i].ray == listed.records[i - 1].ray) ++i;
        return i;
    };
    std::vector<RowMemory> parts((count + part - 1) / part);
    for_chunks(count, part, 0, [&](std::size_t first, std::size_t end, std::size_t) {
        append_listed(scene, listed, ray_begin(first), ray_begin(end), parts[first / part]);
    });
    std::vector<std::pair<std::size_t, std::size_t>> places;  // of the parts' overlaps and regions
    std::size_t overlaps = 0, regions = 0;
    for (const RowMemory& some : parts) {
        places.emplace_back(overlaps, regions);
        overlaps += some.overlaps.size();
        regions += some.overlap_regions.size();
    }
    rows.overlaps.resize(overlaps);
    rows.overlap_regions.resize(regions);
    for_chunks(parts.size(), 1, parts.size() > 1 ? 0 : 1, [&](std::size_t i, std::size_t end, std::size_t) {
        for (; i < end; ++i) {
            const auto [to, first] = places[i];
            std::ranges::copy(parts[i].overlap_regions, rows.overlap_regions.data() + first);
            for (std::size_t k = 0; k < parts[i].overlaps.size(); ++k) {
                rows.overlaps[to + k] = parts[i].overlaps[k];
                rows.overlaps[to + k].first_region += first;
            }
        }
    });
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
