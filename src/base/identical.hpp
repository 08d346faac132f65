// Numbers and answers for one ray, bit by bit. All in the header, as new_file.hpp is.
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

/// To the last bit, overlaps included.
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

}  // namespace csgrt
