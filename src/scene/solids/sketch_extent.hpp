// Extent of curves in a direction of their plane.
#pragma once

#include <utility>
#include <vector>

#include "scene/solids/sketch_curves.hpp"

namespace csgrt {

/// The least and the greatest gu u + gv v over all curves, from outside, to about 1e-15 of the terms.
std::pair<long double, long double> extent_of(const std::vector<BezierCurve>& curves, long double gu, long double gv);

}  // namespace csgrt
