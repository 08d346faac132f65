// Rays, and what they meet: which region holds which part of a ray.
#pragma once

#include <cstdint>
#include <vector>

#include <csgrt/vector.hpp>

namespace csgrt {

/// The ray origin + t x direction, t >= 0. Distances t along it are in units of the direction's length, which may be
/// any but 0: millimetres if the direction is a unit vector. Limits has the range of both.
struct Ray {
    Vec3 origin = {};  ///< millimetres
    Vec3 direction = {};
};

/// A part of a ray that one region holds.
struct Partition {
    double in = 0, out = 0;                     ///< distances t along the ray; in may be negative, both infinite
    Vec3 in_normal = {}, out_normal = {};       ///< unit vectors, outward from the region
    std::uint32_t region = 0;                   ///< index into Renderer::regions()
    std::uint32_t in_solid = 0, out_solid = 0;  ///< whose surfaces these are: index into Renderer::solids()
};

/// A part of a ray that several regions of the same rank claim. Ranks are, from the first: solid regions, FASTGEN's
/// plates, FASTGEN's volumes, air. A region of a later rank yields to one of an earlier rank, which is no overlap. Of
/// regions of the same rank the first in the model gets the partition.
struct Overlap {
    double in = 0, out = 0;                   ///< as in Partition
    std::vector<std::uint32_t> regions = {};  ///< indices into Renderer::regions(), ascending
};

/// Everything along one ray, in the order of distance, but for what ends at a t below 0. Neighbouring partitions of one
/// region are joined. A ray that starts inside a region has a first partition with a negative `in`, which is where that
/// region begins; overlaps likewise.
struct RayPartitions {
    std::vector<Partition> partitions = {};
    std::vector<Overlap> overlaps = {};
};

}  // namespace csgrt
