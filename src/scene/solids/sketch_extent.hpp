// Sketch extent: the extent of curves in a direction of their plane.
#pragma once

#include <utility>
#include <vector>

#include "scene/solids/sketch_curves.hpp"

namespace csgrt {

/// Bounds of the least and the greatest value of gu u + gv v on all curves. They are outer bounds, with errors of about
/// 1e-15 of the terms.
std::pair<long double, long double> extent_of(const std::vector<BezierCurve>& curves, long double gu, long double gv);

}  // namespace csgrt
