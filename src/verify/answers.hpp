// Answers: compares two answers for one ray. Do they have the same regions in the same order?
#pragma once

#include <span>
#include <vector>

#include <csgrt/verify.hpp>

#include "base/identical.hpp"

namespace csgrt {

double length(Vec3 v);
/// |cos| between a ray and a surface's unit normal.
double cosine(Vec3 direction, Vec3 normal);

/// Blur: the sizes of differences that do not count, for one ray.
struct Blur {
    Vec3 direction;
    double tolerance = 0;  ///< millimetres, as are the other members
    double shift = 0;      ///< see csgrt/verify.hpp
    double size = 0;       ///< the diagonal of the model's box

    /// The distance in millimetres that a boundary may move along the ray when the ray moves by `shift`. Where the ray
    /// grazes the surface, this is at most the chord of a line `shift` below the surface of a ball with the diameter
    /// `size`.
    double of(Vec3 normal) const;
    /// Does the partition end so near the ray's start that the blur may move its end before the start? Partitions that
    /// end before the start are left out of answers.
    bool ends_at_start(const Partition& partition) const;
};

/// The partitions that count. Partitions that are too short or end at the ray's start are left out. Two partitions of
/// one region with too short a gap between them become one.
std::vector<Partition> that_count(const std::vector<Partition>& partitions, const Blur& blur);

/// The result of comparing one answer with another.
struct Pairing {
    bool same_regions = false;
    bool as_they_are = false;  ///< true: the same regions without leaving out or joining any partition
};
Pairing pair(const std::vector<Partition>& a, const std::vector<Partition>& b, const Blur& blur);

/// The regions where the answers differ, of the partitions that count.
RegionDifference difference_of(const std::vector<Partition>& exact, const std::vector<Partition>& found,
                               const Blur& blur);

/// Is there an interval where all neighbours are in the same region, or all in none, and `found` differs from them? The
/// interval must be longer than any boundary may move within the blur. An interval before the ray's start does not
/// count if a partition ends there, because some answers have this partition and others leave it out.
bool stands_alone(const std::vector<Partition>& found, std::span<const RayPartitions> neighbours, const Blur& blur);

}  // namespace csgrt
