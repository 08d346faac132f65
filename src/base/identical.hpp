// Identity bit by bit, of numbers and of answers for one ray. The header holds all of the code, as new_file.hpp does.
#pragma once

#include <algorithm>
#include <cstring>
#include <type_traits>

#include <csgrt/partitions.hpp>

namespace csgrt {

/// Whether all numbers of two vectors, matrices or solids are the same bit by bit, signs of zeros too.
template <class Numbers>
bool same_bits(const Numbers& a, const Numbers& b) {
    static_assert(std::is_trivially_copyable_v<Numbers> && sizeof(Numbers) % sizeof(double) == 0);
    return std::memcmp(&a, &b, sizeof a) == 0;
}

/// Whether two answers are the same to the last bit, overlaps included.
inline bool identical(const RayPartitions& a, const RayPartitions& b) {
    const auto same_partition = [](const Partition& p, const Partition& q) {
        return same_bits(p.in, q.in) && same_bits(p.out, q.out) && same_bits(p.in_normal, q.in_normal) &&
               same_bits(p.out_normal, q.out_normal) && p.region == q.region && p.in_solid == q.in_solid &&
               p.out_solid == q.out_solid;
    };
    const auto same_overlap = [](const Overlap& p, const Overlap& q) {
        return same_bits(p.in, q.in) && same_bits(p.out, q.out) && p.regions == q.regions;
    };
    return std::equal(a.partitions.begin(), a.partitions.end(), b.partitions.begin(), b.partitions.end(),
                      same_partition) &&
           std::equal(a.overlaps.begin(), a.overlaps.end(), b.overlaps.begin(), b.overlaps.end(), same_overlap);
}

/// Whether the rows of ray i of `a` are those of ray k of `b`, to the last bit, in all arrays that `a` has.
inline bool same_rows(const Partitions& a, std::size_t i, const Partitions& b, std::size_t k) {
    const auto same = [](const auto& splits_a, std::size_t ia, const auto& splits_b, std::size_t ib,
                         const auto& values_a, const auto& values_b) {
        if (values_a.empty() && values_b.empty()) return true;
        const auto count = static_cast<std::size_t>(splits_a[ia + 1] - splits_a[ia]);
        if (static_cast<std::size_t>(splits_b[ib + 1] - splits_b[ib]) != count) return false;
        return count == 0 || std::memcmp(values_a.data() + splits_a[ia], values_b.data() + splits_b[ib],
                                         count * sizeof *values_a.data()) == 0;
    };
    const auto rows = [&](const auto& values_a, const auto& values_b) {
        return same(a.ray_splits, i, b.ray_splits, k, values_a, values_b);
    };
    if (a.ray_splits[i + 1] - a.ray_splits[i] != b.ray_splits[k + 1] - b.ray_splits[k]) return false;
    bool are_same = rows(a.region_ids, b.region_ids) && rows(a.t_in, b.t_in) && rows(a.t_out, b.t_out) &&
                    rows(a.in_solids, b.in_solids) && rows(a.out_solids, b.out_solids) &&
                    rows(a.in_normals, b.in_normals) && rows(a.out_normals, b.out_normals);
    if (!are_same || a.overlap_splits.empty()) return are_same;
    const auto overlap = a.overlap_splits[i], other = b.overlap_splits[k], count = a.overlap_splits[i + 1] - overlap;
    are_same = same(a.overlap_splits, i, b.overlap_splits, k, a.overlap_t_in, b.overlap_t_in) &&
               same(a.overlap_splits, i, b.overlap_splits, k, a.overlap_t_out, b.overlap_t_out) &&
               b.overlap_splits[k + 1] - other == count;
    for (std::int64_t n = 0; are_same && n < count; ++n)
        are_same = same(a.overlap_region_splits, static_cast<std::size_t>(overlap + n), b.overlap_region_splits,
                        static_cast<std::size_t>(other + n), a.overlap_region_ids, b.overlap_region_ids);
    return are_same;
}

}  // namespace csgrt
