#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "scene/solids/sketch_curves.hpp"
#include "scene/faults/sketches.hpp"
#include "scene/solids/sketch_extent.hpp"
#include "scene/faults/families.hpp"

namespace csgrt {

namespace {

/// The relative rounding error by which a number may exceed a limit that it was computed to equal.
constexpr double rounding = 1e-9;

/// Finds a curve's least u, as far as a profile's check needs it. Only curves with control points beyond the axis are
/// evaluated, at a few points in each span, so that the result is a point of the curve.
struct LeastU {
    const Sketch& sketch;

    double operator()(const Sketch::Line& c) const { return std::min(u_of(c.start), u_of(c.end)); }
    double operator()(const Sketch::Arc& c) const { return least_u(sketch, c); }
    double operator()(const Sketch::Bezier& c) const {
        std::vector<double> knots(2 * c.points.size(), 0.0);
        std::fill(knots.begin() + static_cast<std::ptrdiff_t>(c.points.size()), knots.end(), 1.0);
        return (*this)(Sketch::Nurb{static_cast<std::uint32_t>(c.points.size()), std::move(knots), c.points, {}});
    }
    double operator()(const Sketch::Nurb& c) const {
        double found = std::min(u_of(c.points.front()), u_of(c.points.back()));
        for (std::size_t span = c.order - 1; span < c.points.size(); ++span) {
            if (least(std::span(c.points).subspan(span + 1 - c.order, c.order)) >= 0) continue;
            constexpr int steps = 32;
            for (int i = 0; i <= steps; ++i) {
                const double t = c.knots[span] + (c.knots[span + 1] - c.knots[span]) * i / steps;
                found = std::min(found, u_at(c, span, t));
            }
        }
        return found;
    }

    double u_of(std::uint32_t vertex) const { return sketch.vertices[vertex].u; }
    double least(std::span<const std::uint32_t> vertices) const {
        double u = HUGE_VAL;
        for (const std::uint32_t vertex : vertices) u = std::min(u, u_of(vertex));
        return u;
    }

    /// The curve's u at t, which must be in the span, by de Boor's algorithm with weights.
    double u_at(const Sketch::Nurb& c, std::size_t span, double t) const {
        const std::size_t degree = c.order - 1;
        std::array<double, Limits::curve_degree + 1> u{}, w{};
        for (std::size_t j = 0; j <= degree; ++j) {
            const std::size_t point = span - degree + j;
            w[j] = c.weights.empty() ? 1 : c.weights[point];
            u[j] = w[j] * sketch.vertices[c.points[point]].u;
        }
        for (std::size_t r = 1; r <= degree; ++r) {
            for (std::size_t j = degree; j >= r; --j) {
                const double low = c.knots[span - degree + j], high = c.knots[span + 1 + j - r];
                const double s = high > low ? (t - low) / (high - low) : 0;
                u[j] = (1 - s) * u[j - 1] + s * u[j];
                w[j] = (1 - s) * w[j - 1] + s * w[j];
            }
        }
        return u[degree] / w[degree];
    }
};

/// Checks a profile. Loose ends are allowed, because lines join them to the axis.
void check_profile(Faults& faults, const Sketch& sketch) {
    double size = 0;
    for (const Sketch::Point& p : sketch.vertices) size = std::max({size, std::abs(p.u), std::abs(p.v)});
    const double slack = rounding * size;
    for (std::size_t i = 0; i < sketch.curves.size(); ++i) {
        if (std::visit(LeastU{sketch}, sketch.curves[i]) >= -slack) continue;
        faults.push_back("curve " + std::to_string(i) + " of its sketch crosses the axis: u must be 0 or more");
        return;
    }
    if (!(extent_of(bezier_curves(sketch), 1, 0).second > 0)) {
        faults.push_back("its sketch does not reach out from the axis");
    }
}

/// Has the outline loose ends? Gaps that are too small for BRL-CAD do not count, because they are closed.
bool is_open(const Sketch& sketch) {
    if (open_ends(sketch).empty()) return false;
    std::vector<BezierCurve> curves = bezier_curves(sketch);
    return !close_gaps(curves).empty();
}

void add(Faults& faults, Faults more) { std::move(more.begin(), more.end(), std::back_inserter(faults)); }

}  // namespace

void check_further(Faults& faults, const Extrude& s) {
    if (faults.empty() && dependent(s.a, s.b, s.h))
        faults.push_back("the vectors a and b and the height lie in one plane");
    const Faults of_sketch = sketch_faults(s.sketch);
    add(faults, of_sketch);
    if (!of_sketch.empty() || !is_open(s.sketch)) return;
    faults.push_back("its sketch is open at vertex " + std::to_string(open_ends(s.sketch).front()) +
                     ": curves must form closed loops");
}

void check_further(Faults& faults, const Revolve& s) {
    const Faults of_sketch = sketch_faults(s.sketch);
    add(faults, of_sketch);
    if (of_sketch.empty()) check_profile(faults, s.sketch);
}

}  // namespace csgrt
