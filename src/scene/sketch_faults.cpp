// What is wrong with a sketch, curve by curve.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "scene/sketch_curves.hpp"
#include "scene/sketch_reach.hpp"

namespace csgrt {

namespace {

/// An arc's radius may fall short of half the chord by this part of it: rounding of a half circle's.
constexpr double short_radius = 1e-5;
/// By this part of its width a profile may lie beyond the axis: rounding.
constexpr long double beyond_axis = 1e-9L;

std::string number(std::uint64_t n) { return std::to_string(n); }

/// What is wrong with one curve; empty: nothing.
struct CurveFault {
    const Sketch& sketch;

    std::string range(const std::vector<std::uint32_t>& points) const {
        for (const std::uint32_t i : points)
            if (i >= sketch.vertices.size())
                return "refers to vertex " + number(i) + ", and there are " + number(sketch.vertices.size());
        return {};
    }
    std::string degree(std::size_t points) const {
        if (points < 2) return "has fewer than two points";
        if (points - 1 <= Limits::curve_degree) return {};
        return "is of degree " + number(points - 1) + "; at most " + number(Limits::curve_degree) + " is supported";
    }

    std::string operator()(const Sketch::Line& line) const { return range({line.start, line.end}); }

    std::string operator()(const Sketch::Arc& arc) const {
        if (std::string fault = range({arc.start, arc.end}); !fault.empty()) return fault;
        if (!std::isfinite(arc.radius)) return "has a radius that is not finite";
        if (arc.radius == 0) return "has the radius 0";
        const Sketch::Point &p = sketch.vertices[arc.start], &q = sketch.vertices[arc.end];
        const double chord = std::hypot(p.u - q.u, p.v - q.v);
        if (chord == 0) return arc.radius < 0 ? "is a circle of radius 0" : "starts and ends in one point";
        if (arc.radius > 0 && arc.radius < 0.5 * chord * (1 - short_radius))
            return "has the radius " + std::to_string(arc.radius) + ", less than half of what it spans, " +
                   std::to_string(chord);
        return {};
    }

    std::string operator()(const Sketch::Bezier& bezier) const {
        std::string fault = degree(bezier.points.size());
        return fault.empty() ? range(bezier.points) : fault;
    }

    std::string operator()(const Sketch::Nurb& nurb) const {
        if (nurb.order < 2) return "is of order " + number(nurb.order) + ", less than 2";
        if (std::string fault = degree(nurb.order); !fault.empty()) return fault;
        if (nurb.points.size() < nurb.order)
            return "has " + number(nurb.points.size()) + " points, fewer than its order, " + number(nurb.order);
        if (nurb.knots.size() != nurb.points.size() + nurb.order)
            return "has " + number(nurb.knots.size()) + " knots, not " + number(nurb.points.size() + nurb.order) +
                   ": as many as its points and its order together";
        if (!nurb.weights.empty() && nurb.weights.size() != nurb.points.size())
            return "has " + number(nurb.weights.size()) + " weights for " + number(nurb.points.size()) + " points";
        const auto infinite = [](double x) { return !std::isfinite(x); };
        if (std::any_of(nurb.knots.begin(), nurb.knots.end(), infinite) ||
            std::any_of(nurb.weights.begin(), nurb.weights.end(), infinite))
            return "has a knot or a weight that is not finite";
        if (!std::is_sorted(nurb.knots.begin(), nurb.knots.end())) return "has knots that do not ascend";
        if (!(nurb.knots[nurb.order - 1] < nurb.knots[nurb.points.size()])) return "has knots that span nothing";
        if (std::any_of(nurb.weights.begin(), nurb.weights.end(), [](double w) { return !(w > 0); }))
            return "has a weight that is not greater than 0";
        return range(nurb.points);
    }
};

}  // namespace

std::vector<std::string> sketch_faults(const Sketch& sketch) {
    std::vector<std::string> faults;
    for (const Sketch::Point& p : sketch.vertices)
        if (!std::isfinite(p.u) || !std::isfinite(p.v)) return {"its sketch has a vertex that is not finite"};
    if (sketch.curves.empty()) return {"its sketch has no curves"};
    for (std::size_t i = 0; i < sketch.curves.size(); ++i)
        if (std::string fault = std::visit(CurveFault{sketch}, sketch.curves[i]); !fault.empty())
            faults.push_back("curve " + number(i) + " of its sketch " + fault);
    return faults;
}

std::vector<std::string> closed_sketch_faults(const Sketch& sketch) {
    std::vector<std::string> faults = sketch_faults(sketch);
    if (!faults.empty()) return faults;
    std::vector<CurvePiece> pieces = curve_pieces(sketch);
    const std::vector<CurvePoint> ends = close_gaps(pieces);
    if (ends.empty()) return {};
    std::ostringstream text;
    text << "its sketch is not closed: an odd number of curves ends at (" << ends[0].u << ", " << ends[0].v << ")";
    if (ends.size() > 1) text << " and at " << ends.size() - 1 << (ends.size() > 2 ? " other points" : " other point");
    return {text.str()};
}

std::vector<std::string> turned_sketch_faults(const Sketch& sketch) {
    std::vector<std::string> faults = sketch_faults(sketch);
    if (!faults.empty()) return faults;
    const auto [least, greatest] = reach_of(curve_pieces(sketch), 1, 0);
    if (!(greatest > 0)) return {"its sketch does not reach out from the axis"};
    if (least < -beyond_axis * greatest) {
        std::ostringstream text;
        text << "its sketch crosses the axis, to " << least;
        return {text.str()};
    }
    return {};
}

}  // namespace csgrt
