// Answers: compares two answers for one ray. Do they have the same regions, and which of their boundaries belong
// together?
#pragma once

#include <span>
#include <vector>

#include <csgrt/verify.hpp>

#include "base/identical.hpp"

namespace csgrt {

double length(Vec3 v);
/// |cos| between a ray and a surface's unit normal.
double cosine(Vec3 direction, Vec3 normal);

/// Blur: the differences that do not count on one ray.
struct Blur {
    Vec3 direction;
    double tolerance = 0;  ///< millimetres, as are the other members
    double shift = 0;      ///< see verify.hpp
    double size = 0;       ///< of the model

    /// The distance that a boundary may move along the ray when the ray moves by `shift`, in millimetres. Where the ray
    /// grazes a surface, it is at most the distance between a ball of the model's size and its tangent.
    double of(Vec3 normal) const;
    /// Does the partition end so near the ray's start that it may end before it? Partitions that end before it are left
    /// out.
    bool ends_at_start(const Partition& partition) const;
};

/// The partitions that count: without those that are too short or end at the ray's start, and without gaps between two
/// of one region that are too short.
std::vector<Partition> that_count(const std::vector<Partition>& partitions, const Blur& blur);

/// The result of comparing one answer with another.
struct Pairing {
    bool same_regions = false;
    bool as_they_are = false;  ///< partition by partition, without leaving any out
};
Pairing pair(const std::vector<Partition>& a, const std::vector<Partition>& b, const Blur& blur);

/// The position where they differ, among the partitions that count.
RegionDifference difference_of(const std::vector<Partition>& exact, const std::vector<Partition>& found,
                               const Blur& blur);

/// Is there an interval over which all neighbours meet the same region, or all meet none, and this answer differs? The
/// interval is longer than any boundary may move within the blur. Before the start it does not count if a partition
/// ends there: some answers have it, others leave it out.
bool stands_alone(const std::vector<Partition>& found, std::span<const RayPartitions> neighbours, const Blur& blur);

}  // namespace csgrt
