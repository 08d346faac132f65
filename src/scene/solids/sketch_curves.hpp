// A sketch's curves in one form: rational Bezier pieces.
#pragma once

#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

/// A control point and its weight.
struct CurvePoint {
    long double u = 0, v = 0, weight = 1;
};
/// A rational Bezier curve of degree size - 1; the weights at its ends are 1. Two points: a straight line.
using CurvePiece = std::vector<CurvePoint>;

/// All curves of a sound sketch (see `sketch_faults`). Where pieces meet in a vertex their ends are that vertex, bit by
/// bit. Arcs come in pieces of at most 90 degrees, B-splines in one a span of their knots.
std::vector<CurvePiece> curve_pieces(const Sketch& sketch);

/// The points where an odd number of pieces ends: a closed outline has none.
std::vector<CurvePoint> loose_ends(const std::vector<CurvePiece>& pieces);

/// Joins loose ends that are nearer to each other than BRL-CAD tells points apart, by lines. Returns those that are
/// left.
std::vector<CurvePoint> close_gaps(std::vector<CurvePiece>& pieces);

/// All curves and the lines that close gaps.
std::vector<CurvePiece> closed_pieces(const Sketch& sketch);

/// All curves of a profile that is turned about u = 0: ends that stay loose are joined to the axis, straight across.
std::vector<CurvePiece> turned_pieces(const Sketch& sketch);

}  // namespace csgrt
