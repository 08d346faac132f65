// Sketch curves in one form: rational Bezier curves.
#pragma once

#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

/// A control point and its weight.
struct CurvePoint {
    long double u = 0, v = 0, weight = 1;
};
/// A rational Bezier curve of degree size - 1, with weights of 1 at both ends. Two points: a straight line.
using BezierCurve = std::vector<CurvePoint>;

/// All curves of a sound sketch (see `sketch_faults`). Where they meet in a vertex their ends are this vertex, bit by
/// bit. Arcs come in parts of at most 90 degrees, B-splines in one part a span of their knots.
std::vector<BezierCurve> bezier_curves(const Sketch& sketch);

/// The points where an odd number of curves ends: a closed outline has none.
std::vector<CurvePoint> loose_ends(const std::vector<BezierCurve>& curves);

/// Joins by lines the loose ends that BRL-CAD takes for one point. Returns the others.
std::vector<CurvePoint> close_gaps(std::vector<BezierCurve>& curves);

/// All curves, with the lines that close gaps.
std::vector<BezierCurve> closed_curves(const Sketch& sketch);

/// All curves of a profile that is turned about u = 0: loose ends are joined to the axis, straight across.
std::vector<BezierCurve> turned_curves(const Sketch& sketch);

}  // namespace csgrt
