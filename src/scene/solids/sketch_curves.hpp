// Sketch curves: converts all types of curves to rational Bezier curves.
#pragma once

#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

/// A control point and its weight.
struct CurvePoint {
    long double u = 0, v = 0, weight = 1;
};
/// A rational Bezier curve of degree size - 1, with weights of 1 at both ends. A curve of two points is a straight
/// line.
using BezierCurve = std::vector<CurvePoint>;

/// All curves of a sketch without faults (see `sketch_faults`). Ends at a vertex have the vertex's bits. Arcs are
/// divided into parts of at most 90 degrees, and B-splines into one part for each span of knots.
std::vector<BezierCurve> bezier_curves(const Sketch& sketch);

/// The points where an odd number of curves end. A closed outline has no such points.
std::vector<CurvePoint> loose_ends(const std::vector<BezierCurve>& curves);

/// Adds lines between loose ends that BRL-CAD takes for one point. Returns the other loose ends.
std::vector<CurvePoint> close_gaps(std::vector<BezierCurve>& curves);

/// All curves, with the lines that close gaps.
std::vector<BezierCurve> closed_curves(const Sketch& sketch);

/// All curves of a profile that is turned about u = 0, with lines from loose ends straight to the axis.
std::vector<BezierCurve> turned_curves(const Sketch& sketch);

}  // namespace csgrt
