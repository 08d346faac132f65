#include "scene/faults/sketches.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "scene/faults/families.hpp"

namespace csgrt {

namespace {

/// Finds the first fault of a curve.
struct CurveFault {
    const std::vector<Sketch::Point>& vertices;

    std::string missing(const std::vector<std::uint32_t>& used) const {
        for (const std::uint32_t vertex : used) {
            if (vertex >= vertices.size()) return uses_missing_vertex(vertex, vertices.size());
        }
        return {};
    }

    static std::string too_steep(std::size_t degree) {
        return " is of degree " + std::to_string(degree) + "; at most " + std::to_string(Limits::curve_degree) +
               " is supported";
    }

    std::string operator()(const Sketch::Line& c) const { return missing({c.start, c.end}); }

    std::string operator()(const Sketch::Arc& c) const {
        if (const std::string fault = missing({c.start, c.end}); !fault.empty()) return fault;
        if (!std::isfinite(c.radius)) return " has a radius that is not finite";
        if (std::abs(c.radius) > Limits::length)
            return " has the radius " + number_text(c.radius) + "; " + length_limit();
        const Sketch::Point &p = vertices[c.start], &q = vertices[c.end];
        const double chord = std::hypot(q.u - p.u, q.v - p.v);
        if (chord == 0) return c.radius < 0 ? " is a circle of radius 0" : " is an arc from a place to itself";
        if (c.radius == 0) return " is an arc of radius 0";
        if (c.radius > 0 && chord > 2 * c.radius * (1 + Limits::half_circle)) {
            return " is an arc of too small a radius, " + number_text(c.radius) + ": its ends are " +
                   number_text(chord) + " apart, which is more than the diameter by " +
                   rounded_text(chord / (2 * c.radius) - 1) + " of it; at most " + rounded_text(Limits::half_circle) +
                   " is taken for a half circle";
        }
        return {};
    }

    std::string operator()(const Sketch::Bezier& c) const {
        if (c.points.size() < 2) return " has fewer than 2 points";
        if (c.points.size() > Limits::curve_degree + 1) return too_steep(c.points.size() - 1);
        return missing(c.points);
    }

    std::string operator()(const Sketch::Nurb& c) const {
        const std::size_t order = c.order;
        if (order < 2) return " must be of order 2 or more";
        if (order > Limits::curve_degree + 1) return too_steep(order - 1);
        if (c.points.size() < order) return " has fewer points than its order";
        if (const std::string fault = missing(c.points); !fault.empty()) return fault;
        if (c.knots.size() != c.points.size() + order) {
            return " needs " + std::to_string(c.points.size() + order) + " knots, one for each point and " +
                   std::to_string(order) + " for its order, found " + std::to_string(c.knots.size());
        }
        if (!c.weights.empty() && c.weights.size() != c.points.size()) {
            return " needs a weight for each of its " + std::to_string(c.points.size()) + " points, found " +
                   std::to_string(c.weights.size());
        }
        const auto is_weight = [](double w) { return w > 0 && std::isfinite(w); };
        if (!std::all_of(c.weights.begin(), c.weights.end(), is_weight)) return " has a weight that is not above 0";
        return knot_fault(c.knots, order);
    }

    static std::string knot_fault(const std::vector<double>& knots, std::size_t order) {
        if (!std::all_of(knots.begin(), knots.end(), [](double k) { return std::isfinite(k); })) {
            return " has a knot that is not finite";
        }
        if (!std::is_sorted(knots.begin(), knots.end())) return " has knots that decrease";
        const std::size_t last = knots.size() - 1;
        if (knots[0] != knots[order - 1] || knots[last] != knots[last + 1 - order]) {
            return " must end at its first and last points: the first and the last " + std::to_string(order) +
                   " knots must be equal";
        }
        for (std::size_t i = 1; i + order < knots.size(); ++i) {
            if (knots[i] != knots[i + order - 1]) continue;
            return i == 1 || i + order + 1 == knots.size() ? " has too many equal knots at an end"
                                                           : " is broken by " + std::to_string(order) + " equal knots";
        }
        return {};
    }
};

/// The vertices at a curve's ends. Nothing for a circle.
struct EndsOf {
    using Ends = std::optional<std::pair<std::uint32_t, std::uint32_t>>;
    Ends operator()(const Sketch::Line& c) const { return Ends({c.start, c.end}); }
    Ends operator()(const Sketch::Arc& c) const { return c.radius < 0 ? std::nullopt : Ends({c.start, c.end}); }
    Ends operator()(const Sketch::Bezier& c) const { return Ends({c.points.front(), c.points.back()}); }
    Ends operator()(const Sketch::Nurb& c) const { return Ends({c.points.front(), c.points.back()}); }
};

}  // namespace

std::vector<std::string> sketch_faults(const Sketch& sketch) {
    Faults faults;
    if (!require_at_most(faults, "curves", sketch.curves.size(), Limits::curves)) return faults;
    if (sketch.curves.empty()) return {"its sketch has no curves"};
    for (std::size_t i = 0; i < sketch.vertices.size(); ++i) {
        const auto& [u, v] = sketch.vertices[i];
        const double most = std::max(std::abs(u), std::abs(v));
        const auto vertex = [i] { return "vertex " + std::to_string(i) + " of its sketch has "; };
        if (!std::isfinite(u) || !std::isfinite(v)) return {vertex() + "a number that is not finite"};
        if (most > Limits::length) return {vertex() + "the number " + number_text(most) + "; " + length_limit()};
    }
    for (std::size_t i = 0; i < sketch.curves.size(); ++i) {
        const std::string fault = std::visit(CurveFault{sketch.vertices}, sketch.curves[i]);
        if (!fault.empty()) faults.push_back("curve " + std::to_string(i) + " of its sketch" + fault);
    }
    if (!sketch.reversed.empty() && sketch.reversed.size() != sketch.curves.size()) {
        faults.push_back("its sketch has " + std::to_string(sketch.curves.size()) + " curves, and directions for " +
                         std::to_string(sketch.reversed.size()));
    }
    return faults;
}

std::vector<std::uint32_t> open_ends(const Sketch& sketch) {
    std::vector<std::uint32_t> ends;
    for (const Sketch::Curve& curve : sketch.curves)
        if (const auto both = std::visit(EndsOf{}, curve)) ends.insert(ends.end(), {both->first, both->second});
    // Vertices at the same position count as one vertex.
    const auto place = [&](std::uint32_t v) { return std::pair(sketch.vertices[v].u, sketch.vertices[v].v); };
    std::sort(ends.begin(), ends.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(place(a), a) < std::pair(place(b), b); });
    std::vector<std::uint32_t> open;
    for (std::size_t i = 0, next = 0; i < ends.size(); i = next) {
        while (next < ends.size() && place(ends[next]) == place(ends[i])) ++next;
        if ((next - i) % 2 == 1) open.push_back(ends[i]);
    }
    std::sort(open.begin(), open.end());
    return open;
}

double least_u(const Sketch& sketch, const Sketch::Arc& arc) {
    const Sketch::Point &p = sketch.vertices[arc.start], &q = sketch.vertices[arc.end];
    const double du = q.u - p.u, dv = q.v - p.v, chord = std::hypot(du, dv);
    if (arc.radius < 0) return q.u - chord;
    const double away = std::sqrt(std::max(0.0, (arc.radius - chord / 2) * (arc.radius + chord / 2)));
    const double left = arc.center_left ? away : -away;
    const double u = (p.u + q.u) / 2 - left * dv / chord, v = (p.v + q.v) / 2 + left * du / chord;
    // The circle's point with the least u is on the arc if it is on the same side of the chord. A clockwise arc is on
    // the left side.
    const double side = du * (v - p.v) - dv * (u - arc.radius - p.u);
    const bool on_arc = arc.clockwise ? side > 0 : side < 0;
    return on_arc ? u - arc.radius : std::min(p.u, q.u);
}

}  // namespace csgrt
