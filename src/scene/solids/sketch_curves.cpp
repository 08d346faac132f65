#include "scene/solids/sketch_curves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace csgrt {

namespace {

/// The distance in millimetres below which BRL-CAD takes two points for one.
constexpr long double same_point = 0.0005L;
/// The largest number of loose ends for which gaps are searched, pair by pair. A sketch with more is not meant to be
/// closed.
constexpr std::size_t gaps_to_close = 1000;

struct Converter {
    const Sketch& sketch;
    std::vector<BezierCurve> curves;

    CurvePoint vertex(std::uint32_t i) const { return {sketch.vertices[i].u, sketch.vertices[i].v, 1}; }

    void operator()(const Sketch::Line& line) { curves.push_back({vertex(line.start), vertex(line.end)}); }

    void operator()(const Sketch::Arc& arc) {
        const CurvePoint start = vertex(arc.start), end = vertex(arc.end);
        if (arc.radius < 0) {
            circle(start, end);
        } else {
            Converter::arc(start, end, arc);
        }
    }

    /// Adds a circle around `center`, in four parts.
    void circle(const CurvePoint& start, const CurvePoint& center) {
        long double x = start.u - center.u, y = start.v - center.v;
        CurvePoint from = start;
        for (int quarter = 0; quarter < 4; ++quarter) {
            const CurvePoint corner{center.u + (x - y), center.v + (x + y), 0.5L * std::numbers::sqrt2_v<long double>};
            const long double turned = -y;
            y = x;
            x = turned;
            const CurvePoint to = quarter == 3 ? start : CurvePoint{center.u + x, center.v + y, 1};
            curves.push_back({from, corner, to});
            from = to;
        }
    }

    /// Adds an arc. The angle phi goes from -alpha to alpha, and is 0 in the arc's middle. Points are computed from the
    /// chord, because the centre may be far away: r (cos phi - cos alpha) perpendicular to the chord, and r sin phi
    /// along it.
    void arc(const CurvePoint& start, const CurvePoint& end, const Sketch::Arc& arc) {
        const long double x = end.u - start.u, y = end.v - start.v, chord = std::hypot(x, y), half = chord / 2;
        const long double r = std::max<long double>(arc.radius, half);
        const long double to_center = std::sqrt((r - half) * (r + half));
        const bool minor = arc.center_left != arc.clockwise;  // less than half a circle
        const long double alpha = std::atan2(half, minor ? to_center : -to_center);
        const int count = std::max(1, static_cast<int>(std::ceil(4 * alpha / std::numbers::pi_v<long double> - 1e-9L)));
        const long double delta = alpha / count;
        const long double ex = x / chord, ey = y / chord, side = arc.clockwise ? -1 : 1;
        const auto at = [&](long double along, long double across) {
            return CurvePoint{(start.u + end.u) / 2 + along * ex + across * side * ey,
                              (start.v + end.v) / 2 + along * ey - across * side * ex, 1};
        };
        const auto rise = [&](long double phi) {  // cos phi - cos alpha
            return 2 * std::sin((alpha + phi) / 2) * std::sin((alpha - phi) / 2);
        };
        CurvePoint from = start;
        for (int i = 0; i < count; ++i) {
            const long double middle = (2 * i + 1) * delta - alpha, last = (2 * i + 2) * delta - alpha;
            const long double cosine = std::cos(delta),
                              lift = 2 * std::cos(alpha) * std::pow(std::sin(delta / 2), 2.0L);
            CurvePoint corner = at(r * std::sin(middle) / cosine, r * (rise(middle) + lift) / cosine);
            corner.weight = cosine;
            const CurvePoint to = i + 1 == count ? end : at(r * std::sin(last), r * rise(last));
            curves.push_back({from, corner, to});
            from = to;
        }
    }

    void operator()(const Sketch::Bezier& bezier) {
        BezierCurve curve;
        for (const std::uint32_t i : bezier.points) curve.push_back(vertex(i));
        curves.push_back(std::move(curve));
    }

    /// Adds a B-spline. The control points of each span are values of the curve's polar form at the span's two knots
    /// (Ramshaw 1987).
    void operator()(const Sketch::Nurb& nurb) {
        const std::size_t degree = nurb.order - 1, count = nurb.points.size();
        const auto polar = [&](std::size_t span, const std::vector<double>& at) {
            BezierCurve points;  // homogeneous coordinates
            for (std::size_t i = span - degree; i <= span; ++i) {
                const CurvePoint p = vertex(nurb.points[i]);
                const long double w = nurb.weights.empty() ? 1 : nurb.weights[i];
                points.push_back({p.u * w, p.v * w, w});
            }
            for (std::size_t round = 1; round <= degree; ++round)
                for (std::size_t i = degree; i >= round; --i) {
                    const long double low = nurb.knots[i + span - degree], high = nurb.knots[i + span - round + 1];
                    const long double t = (at[round - 1] - low) / (high - low);
                    const CurvePoint &a = points[i - 1], &b = points[i];
                    points[i] = {(1 - t) * a.u + t * b.u, (1 - t) * a.v + t * b.v, (1 - t) * a.weight + t * b.weight};
                }
            const CurvePoint& p = points[degree];
            return CurvePoint{p.u / p.weight, p.v / p.weight, p.weight};
        };
        const std::size_t first = curves.size();
        for (std::size_t span = degree; span < count; ++span) {
            const double low = nurb.knots[span], high = nurb.knots[span + 1];
            if (!(low < high)) continue;
            BezierCurve curve;
            std::vector<double> at(degree, low);
            for (std::size_t i = 0; i <= degree; ++i) {
                curve.push_back(polar(span, at));
                if (i < degree) at[i] = high;
            }
            normalize(curve);
            if (curves.size() > first) curve.front() = curves.back().back();
            curves.push_back(std::move(curve));
        }
        snap(curves[first].front(), vertex(nurb.points.front()));
        snap(curves.back().back(), vertex(nurb.points.back()));
    }

    /// Makes the weights at both ends 1, by multiplying weight i by c s^i. This changes the parameter, not the curve's
    /// shape.
    static void normalize(BezierCurve& curve) {
        const long double degree = static_cast<long double>(curve.size() - 1), scale = 1 / curve.front().weight;
        const long double pace = std::pow(curve.front().weight / curve.back().weight, 1 / degree);
        long double factor = scale;
        for (CurvePoint& p : curve) {
            p.weight *= factor;
            factor *= pace;
        }
        curve.front().weight = curve.back().weight = 1;
    }

    /// Moves a curve's end onto a vertex if only rounding separates them.
    static void snap(CurvePoint& end, const CurvePoint& vertex) {
        const long double size = std::max(std::fabs(vertex.u), std::fabs(vertex.v));
        if (std::hypot(end.u - vertex.u, end.v - vertex.v) <= 1e-16L * size) end = vertex;
    }
};

bool before(const CurvePoint& a, const CurvePoint& b) { return a.u != b.u ? a.u < b.u : a.v < b.v; }

}  // namespace

std::vector<BezierCurve> bezier_curves(const Sketch& sketch) {
    Converter converter{sketch, {}};
    for (const Sketch::Curve& curve : sketch.curves) std::visit(converter, curve);
    return std::move(converter.curves);
}

std::vector<CurvePoint> loose_ends(const std::vector<BezierCurve>& curves) {
    std::vector<CurvePoint> ends, loose;
    for (const BezierCurve& curve : curves) {
        ends.push_back(curve.front());
        ends.push_back(curve.back());
    }
    std::sort(ends.begin(), ends.end(), before);
    for (std::size_t i = 0; i < ends.size();) {
        std::size_t next = i;
        while (next < ends.size() && !before(ends[i], ends[next])) ++next;
        if ((next - i) % 2 == 1) loose.push_back(ends[i]);
        i = next;
    }
    return loose;
}

std::vector<CurvePoint> close_gaps(std::vector<BezierCurve>& curves) {
    std::vector<CurvePoint> loose = loose_ends(curves), left;
    if (loose.size() > gaps_to_close) return loose;
    while (!loose.empty()) {
        const CurvePoint p = loose.back();
        loose.pop_back();
        const auto gap = [&](const CurvePoint& q) { return std::hypot(p.u - q.u, p.v - q.v); };
        const auto nearest =
            std::min_element(loose.begin(), loose.end(), [&](const auto& a, const auto& b) { return gap(a) < gap(b); });
        if (nearest != loose.end() && gap(*nearest) <= same_point) {
            curves.push_back({p, *nearest});
            loose.erase(nearest);
        } else {
            left.push_back(p);
        }
    }
    return left;
}

std::vector<BezierCurve> closed_curves(const Sketch& sketch) {
    std::vector<BezierCurve> curves = bezier_curves(sketch);
    close_gaps(curves);
    return curves;
}

std::vector<BezierCurve> turned_curves(const Sketch& sketch) {
    std::vector<BezierCurve> curves = bezier_curves(sketch);
    for (const CurvePoint& end : close_gaps(curves))
        if (end.u != 0) curves.push_back({end, {0, end.v, 1}});
    return curves;
}

}  // namespace csgrt
