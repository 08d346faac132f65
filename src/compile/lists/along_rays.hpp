// The arrays of a list, in which nothing was cut -> an object a ray.
#pragma once

#include <vector>

#include <csgrt/partitions.hpp>

namespace csgrt {

/// The arrays have all fields. What ends at a t below 0 is left out.
std::vector<RayPartitions> along_rays(const Partitions& all);

}  // namespace csgrt
