// Boxes of solids that sketches make.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compile/solids/axis_frame.hpp"
#include "compile/solids/cell_outline.hpp"
#include "compile/bounds/tight_box.hpp"
#include "scene/solids/sketch_extent.hpp"

namespace csgrt {

namespace {

struct Interval {
    long double least, greatest;
};

/// The box around v plus a flat shape in the plane of a and b, moved along h. `reach(a, b)` gives the least and the
/// greatest a u + b v of the shape.
template <class Reach>
Box prism_box(const Wide& v, const Wide& a, const Wide& b, const Wide& h, const Reach& reach) {
    Wide low(0), high(0);
    for (int i = 0; i < 3; ++i) {
        const Interval across = reach(a[i], b[i]);
        low[i] = v[i] + across.least + std::min(h[i], 0.0L);
        high[i] = v[i] + across.greatest + std::max(h[i], 0.0L);
    }
    return {narrow(low), narrow(high)};
}

/// The greatest cos(phi - at) for phi from 0 to `angle`.
long double greatest_cosine(long double angle, long double at) {
    constexpr long double turn = 2 * std::numbers::pi_v<long double>;
    at -= turn * std::floor(at / turn);
    return at <= angle ? 1 : std::max(std::cos(at), std::cos(at - angle));
}

}  // namespace

Box Tight::operator()(const Extrude& s) const {
    const std::vector<BezierCurve> curves = closed_curves(s.sketch);
    return prism_box(transform_point(m, wide(s.v)), transform_direction(m, wide(s.a)),
                     transform_direction(m, wide(s.b)), transform_direction(m, wide(s.h)),
                     [&](long double a, long double b) {
                         const auto [least, greatest] = extent_of(curves, a, b);
                         return Interval{least, greatest};
                     });
}

Box Tight::operator()(const Ebm& s) const {
    const auto to_world = [&](const Wide& d) { return transform_direction(m, transform_direction(s.matrix, d)); };
    const std::vector<StraightLine> lines = cell_outline(s);
    return prism_box(transform_point(m, transform_point(s.matrix, Wide(0))), to_world(Wide(1, 0, 0)),
                     to_world(Wide(0, 1, 0)), to_world(Wide(0, 0, s.height)), [&](long double a, long double b) {
                         Interval reach{0, 0};  // without cells any position serves
                         bool first = true;
                         for (const StraightLine& line : lines)
                             for (const long double at : {a * line.u0 + b * line.v0, a * line.u1 + b * line.v1}) {
                                 reach = first ? Interval{at, at}
                                               : Interval{std::min(reach.least, at), std::max(reach.greatest, at)};
                                 first = false;
                             }
                         return reach;
                     });
}

/// In each direction the solid's farthest point is on the profile at the angle of the turn that is nearest to this
/// direction.
Box Tight::operator()(const Revolve& s) const {
    const std::vector<BezierCurve> curves = turned_curves(s.sketch);
    const AxisFrame axes = axis_frame(s);
    const Wide v = transform_point(m, wide(s.v)), x = transform_direction(m, axes.x);
    const Wide y = transform_direction(m, axes.y), z = transform_direction(m, axes.z);
    const auto farthest = [&](long double along_x, long double along_y, long double along_z) {
        const long double across = std::hypot(along_x, along_y);
        const long double lean = across * greatest_cosine(s.angle, std::atan2(along_y, along_x));
        return extent_of(curves, lean, along_z).second;
    };
    Wide low(0), high(0);
    for (int i = 0; i < 3; ++i) {
        low[i] = v[i] - farthest(-x[i], -y[i], -z[i]);
        high[i] = v[i] + farthest(x[i], y[i], z[i]);
    }
    return {narrow(low), narrow(high)};
}

}  // namespace csgrt
