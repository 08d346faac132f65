// The arrays of whole lines -> an object a ray.
#pragma once

#include <limits>
#include <vector>

#include <csgrt/partitions.hpp>

namespace csgrt {

inline constexpr RayRange whole_line{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
inline constexpr Fields all_fields{.solids = true, .normals = true, .overlaps = true};

/// The arrays have all fields. What ends at a t below 0 is left out.
std::vector<RayPartitions> along_rays(const Partitions& all);

}  // namespace csgrt
