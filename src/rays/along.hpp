// Along: converts arrays of partitions to one object a ray.
#pragma once

#include <limits>
#include <vector>

#include <csgrt/partitions.hpp>

namespace csgrt {

inline constexpr RayRange whole_line{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
inline constexpr Fields all_fields{.solids = true, .normals = true, .overlaps = true};

/// Converts arrays, which must have all fields. Partitions that end at t < 0 are left out.
std::vector<RayPartitions> along_rays(const Partitions& all);

}  // namespace csgrt
