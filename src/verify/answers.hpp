// Two answers for one ray: have they the same regions, and which of their ends belong to each other?
#pragma once

#include <span>
#include <vector>

#include <csgrt/verify.hpp>

#include "base/identical.hpp"

namespace csgrt {

double length(Vec3 v);
/// |cos| between a ray and a surface's unit normal.
double cosine(Vec3 direction, Vec3 normal);

/// What does not count on one ray.
struct Blur {
    Vec3 direction;
    double tolerance = 0;  ///< millimetres, as are the others
    double shift = 0;      ///< see verify.hpp
    double size = 0;       ///< of the model

    /// By how much an end may move along the ray when the ray moves by `shift`, in millimetres. Where the ray grazes a
    /// surface that is at most as much as between a ball of the model's size and its tangent.
    double of(Vec3 normal) const;
    /// May the partition end before the ray's start as well as behind it? What ends before it is left out.
    bool ends_at_start(const Partition& partition) const;
};

/// Partitions without those that are too short to count or end at the ray's start, and without gaps between two of one
/// region that are too short.
std::vector<Partition> that_count(const std::vector<Partition>& partitions, const Blur& blur);

/// How one answer compares with another.
struct Pairing {
    bool same_regions = false;
    bool as_they_are = false;  ///< partition by partition, without leaving any out
};
Pairing pair(const std::vector<Partition>& a, const std::vector<Partition>& b, const Blur& blur);

/// Where they differ, by the partitions that count.
RegionDifference difference_of(const std::vector<Partition>& exact, const std::vector<Partition>& found,
                               const Blur& blur);

/// Is there a stretch over which all neighbours meet the same region, or all meet none, and this answer does not? The
/// stretch is longer than any end may move within the blur. Before the start it does not count if a partition ends
/// there: some answers have it, others leave it out.
bool stands_alone(const std::vector<Partition>& found, std::span<const RayPartitions> neighbours, const Blur& blur);

}  // namespace csgrt
