// Along a ray: converts one ray's rows of the arrays to an object. The header holds all of the code, as new_file.hpp
// does.
#pragma once

#include <csgrt/partitions.hpp>

namespace csgrt {

/// Converts the rows of one ray, from arrays that have all fields. The solid -1, which stands where a range cuts a
/// partition, becomes the largest number.
inline RayPartitions along_ray(const Partitions& all, std::size_t ray) {
    RayPartitions one;
    for (auto i = static_cast<std::size_t>(all.ray_splits[ray]); i < static_cast<std::size_t>(all.ray_splits[ray + 1]);
         ++i)
        one.partitions.push_back({.in = all.t_in[i],
                                  .out = all.t_out[i],
                                  .in_normal = all.in_normals[i],
                                  .out_normal = all.out_normals[i],
                                  .region = static_cast<std::uint32_t>(all.region_ids[i]),
                                  .in_solid = static_cast<std::uint32_t>(all.in_solids[i]),
                                  .out_solid = static_cast<std::uint32_t>(all.out_solids[i])});
    for (auto i = static_cast<std::size_t>(all.overlap_splits[ray]);
         i < static_cast<std::size_t>(all.overlap_splits[ray + 1]); ++i)
        one.overlaps.push_back({.in = all.overlap_t_in[i],
                                .out = all.overlap_t_out[i],
                                .regions = {all.overlap_region_ids.begin() + all.overlap_region_splits[i],
                                            all.overlap_region_ids.begin() + all.overlap_region_splits[i + 1]}});
    return one;
}

}  // namespace csgrt
