// Two answers for one ray, bit by bit. All in the header, as new_file.hpp is.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include <csgrt/partitions.hpp>

namespace csgrt {

inline bool same_number(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
inline bool same_vector(Vec3 a, Vec3 b) {
    return same_number(a.x, b.x) && same_number(a.y, b.y) && same_number(a.z, b.z);
}

/// To the last bit, overlaps included.
inline bool identical(const RayPartitions& a, const RayPartitions& b) {
    const auto same_partition = [](const Partition& p, const Partition& q) {
        return same_number(p.in, q.in) && same_number(p.out, q.out) && same_vector(p.in_normal, q.in_normal) &&
               same_vector(p.out_normal, q.out_normal) && p.region == q.region && p.in_solid == q.in_solid &&
               p.out_solid == q.out_solid;
    };
    const auto same_overlap = [](const Overlap& p, const Overlap& q) {
        return same_number(p.in, q.in) && same_number(p.out, q.out) && p.regions == q.regions;
    };
    return std::equal(a.partitions.begin(), a.partitions.end(), b.partitions.begin(), b.partitions.end(),
                      same_partition) &&
           std::equal(a.overlaps.begin(), a.overlaps.end(), b.overlaps.begin(), b.overlaps.end(), same_overlap);
}

}  // namespace csgrt
