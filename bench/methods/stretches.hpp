// From the stretches of each region to the sequence of their owners along the ray.
#pragma once

#include <vector>

#include "bench/chart/accuracy.hpp"

namespace csgrt::bench {

/// Of regions that claim one place the least number owns it. Ends within `epsilon` behind another, along the ray's
/// parameter, are one with it. `claimed`: regions' stretches in any order. `first`: only the first stretch that ends
/// behind the ray's start.
Sequence owners(const std::vector<Stretch>& claimed, double epsilon, bool first);

}  // namespace csgrt::bench
