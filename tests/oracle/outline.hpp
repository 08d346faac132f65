// A sketch by its definition: arcs are circles, Bezier curves Bernstein sums, B-splines the recursion of Cox and de
// Boor; where a line crosses each is found in 113-bit arithmetic, in closed form or between the roots of derivatives.
#pragma once

#include <algorithm>
#include <vector>

#include "quad.hpp"

namespace csgrt::oracle {

/// c[0] + c[1] x + ..., of any degree.
using Coefficients = std::vector<quad>;

inline quad value_at(const Coefficients& c, quad x) {
    quad sum = 0;
    for (std::size_t i = c.size(); i-- > 0;) sum = sum * x + c[i];
    return sum;
}
inline Coefficients derivative_of(const Coefficients& c) {
    Coefficients d;
    for (std::size_t i = 1; i < c.size(); ++i) d.push_back(static_cast<double>(i) * c[i]);
    return d;
}
inline Coefficients product(const Coefficients& a, const Coefficients& b) {
    Coefficients p(a.empty() || b.empty() ? 0 : a.size() + b.size() - 1);
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) p[i + j] += a[i] * b[j];
    return p;
}
/// a + s b
inline Coefficients sum(Coefficients a, quad s, const Coefficients& b) {
    a.resize(std::max(a.size(), b.size()));
    for (std::size_t i = 0; i < b.size(); ++i) a[i] += s * b[i];
    return a;
}

/// Where the sign changes in [low, high], ascending: between two roots of the derivative there is at most one.
inline std::vector<quad> changes_of_sign(const Coefficients& c, quad low, quad high) {
    std::vector<quad> found;
    if (c.size() < 2) return found;
    const Coefficients slope = derivative_of(c);
    std::vector<quad> knots = changes_of_sign(slope, low, high);
    knots.insert(knots.begin(), low);
    knots.push_back(high);
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
        quad a = knots[i], b = knots[i + 1];
        const bool positive = value_at(c, a) > 0;
        if ((value_at(c, b) > 0) == positive) continue;
        quad x = (a + b) / 2, step = b - a;
        for (int round = 0; round < 300 && a < b; ++round) {
            const quad f = value_at(c, x);
            ((f > 0) == positive ? a : b) = x;
            const quad rate = value_at(slope, x);
            quad next = rate == 0 ? a : x - f / rate;
            if (!(next > a && next < b && absolute(next - x) <= step / 2)) next = (a + b) / 2;
            step = absolute(next - x);
            if (step <= quad(1e-33) * (1 + absolute(x))) break;
            x = next;
        }
        found.push_back(x);
    }
    return found;
}

/// A crossing of the line o + s d (z is not used) with a curve, and a normal of the curve there, of any length.
struct PlaneCrossing {
    quad at;
    QVec normal;
};

class Outline {
public:
    explicit Outline(Sketch sketch) : sketch_(std::move(sketch)) {
        for (const Sketch::Curve& curve : sketch_.curves)
            if (const auto* nurb = std::get_if<Sketch::Nurb>(&curve)) add_spans(*nurb);
    }

    /// All crossings, ascending.
    std::vector<PlaneCrossing> crossings(const QVec& o, const QVec& d) const {
        std::vector<PlaneCrossing> found;
        for (const Sketch::Curve& curve : sketch_.curves)
            std::visit([&](const auto& c) { cross_curve(c, o, d, found); }, curve);
        for (const Rational& r : spans_) cross_rational(r, o, d, found);
        std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.at < b.at; });
        return found;
    }
    bool contains(const QVec& p) const {
        const auto found = crossings(p, {1, quad(0.0078125), 0});
        return std::count_if(found.begin(), found.end(), [](const auto& c) { return c.at > 0; }) % 2 == 1;
    }

    /// x(t) / w(t), y(t) / w(t) for t from low to high.
    struct Rational {
        Coefficients x, y, w;
        quad low = 0, high = 1;
    };
    static Rational bezier(const Sketch& sketch, const Sketch::Bezier& curve) {
        Rational r;
        const std::size_t degree = curve.points.size() - 1;
        quad binomial = 1;
        r.w = {1};
        for (std::size_t i = 0; i <= degree; ++i) {
            Coefficients basis{binomial};
            for (std::size_t k = 0; k < i; ++k) basis = product(basis, {0, 1});
            for (std::size_t k = i; k < degree; ++k) basis = product(basis, {1, -1});
            r.x = sum(r.x, sketch.vertices[curve.points[i]].u, basis);
            r.y = sum(r.y, sketch.vertices[curve.points[i]].v, basis);
            binomial = binomial * static_cast<double>(degree - i) / static_cast<double>(i + 1);
        }
        return r;
    }
    const std::vector<Rational>& spans() const { return spans_; }

    struct Circle {
        QVec center;
        quad radius;
    };
    static Circle circle(const Sketch& sketch, const Sketch::Arc& arc) {
        const QVec start = point(sketch, arc.start), end = point(sketch, arc.end);
        if (arc.radius < 0) return {end, length(start - end)};
        const QVec chord = end - start;
        const quad r = arc.radius, half = length(chord) / 2;
        const QVec left = unit(QVec{-chord.y, chord.x, 0});
        const quad off = r > half ? root(r * r - half * half) : quad(0);
        return {quad(0.5) * (start + end) + (arc.center_left ? off : -off) * left, larger(r, half)};
    }
    /// Is a point of its circle one of the arc? Counterclockwise from start to end lies to the right of that chord.
    static bool on_arc(const Sketch& sketch, const Sketch::Arc& arc, const QVec& p) {
        if (arc.radius < 0) return true;
        const QVec start = point(sketch, arc.start), chord = point(sketch, arc.end) - start, off = p - start;
        const quad left = chord.x * off.y - chord.y * off.x;
        return arc.clockwise ? left > 0 : left < 0;
    }
    static QVec point(const Sketch& sketch, std::uint32_t i) { return {sketch.vertices[i].u, sketch.vertices[i].v, 0}; }
    const Sketch& sketch() const { return sketch_; }

private:
    using Found = std::vector<PlaneCrossing>;

    static quad side(const QVec& o, const QVec& d, const QVec& p) { return d.x * (p.y - o.y) - d.y * (p.x - o.x); }
    static quad along(const QVec& o, const QVec& d, const QVec& p) {
        return (d.x * (p.x - o.x) + d.y * (p.y - o.y)) / (d.x * d.x + d.y * d.y);
    }

    void cross_curve(const Sketch::Line& line, const QVec& o, const QVec& d, Found& found) const {
        const QVec p = point(sketch_, line.start), q = point(sketch_, line.end);
        const quad at_p = side(o, d, p), at_q = side(o, d, q);
        if ((at_p > 0) == (at_q > 0)) return;
        const QVec hit = p + (at_p / (at_p - at_q)) * (q - p);
        found.push_back({along(o, d, hit), {q.y - p.y, p.x - q.x, 0}});
    }
    void cross_curve(const Sketch::Arc& arc, const QVec& o, const QVec& d, Found& found) const {
        const Circle c = circle(sketch_, arc);
        const quad speed2 = d.x * d.x + d.y * d.y, off = side(o, d, c.center);
        const quad half2 = c.radius * c.radius - off * off / speed2;
        if (!(half2 > 0)) return;
        const quad middle = along(o, d, c.center), half = root(half2 / speed2);
        for (const quad at : {middle - half, middle + half}) {
            const QVec p{o.x + at * d.x, o.y + at * d.y, 0};
            if (on_arc(sketch_, arc, p)) found.push_back({at, p - c.center});
        }
    }
    void cross_curve(const Sketch::Bezier& curve, const QVec& o, const QVec& d, Found& found) const {
        cross_rational(bezier(sketch_, curve), o, d, found);
    }
    void cross_curve(const Sketch::Nurb&, const QVec&, const QVec&, Found&) const {}

    static void cross_rational(const Rational& r, const QVec& o, const QVec& d, Found& found) {
        const Coefficients dx = sum(r.x, -o.x, r.w), dy = sum(r.y, -o.y, r.w);
        Coefficients f = sum({}, d.x, dy);
        f = sum(f, -d.y, dx);
        for (const quad t : changes_of_sign(f, r.low, r.high)) {
            const quad x = value_at(r.x, t), y = value_at(r.y, t), w = value_at(r.w, t);
            const quad xs = value_at(derivative_of(r.x), t), ys = value_at(derivative_of(r.y), t),
                       ws = value_at(derivative_of(r.w), t);
            found.push_back({along(o, d, {x / w, y / w, 0}), {ys * w - y * ws, x * ws - xs * w, 0}});
        }
    }

    /// The basis functions on each span of knots, as polynomials.
    void add_spans(const Sketch::Nurb& nurb) {
        const std::size_t degree = nurb.order - 1, count = nurb.points.size();
        const auto& knots = nurb.knots;
        for (std::size_t span = degree; span < count; ++span) {
            if (!(knots[span] < knots[span + 1])) continue;
            std::vector<Coefficients> basis(knots.size() - 1);
            basis[span] = {1};
            for (std::size_t k = 1; k <= degree; ++k)
                for (std::size_t i = 0; i + k + 1 < knots.size(); ++i) {
                    Coefficients next;
                    const quad rise = quad(knots[i + k]) - knots[i], fall = quad(knots[i + k + 1]) - knots[i + 1];
                    if (rise > 0) next = sum(next, 1 / rise, product(basis[i], {-quad(knots[i]), 1}));
                    if (fall > 0) next = sum(next, 1 / fall, product(basis[i + 1], {quad(knots[i + k + 1]), -1}));
                    basis[i] = next;
                }
            Rational r;
            r.low = knots[span], r.high = knots[span + 1];
            for (std::size_t i = 0; i < count; ++i) {
                const quad w = nurb.weights.empty() ? 1 : nurb.weights[i];
                const QVec p = point(sketch_, nurb.points[i]);
                r.x = sum(r.x, w * p.x, basis[i]), r.y = sum(r.y, w * p.y, basis[i]), r.w = sum(r.w, w, basis[i]);
            }
            spans_.push_back(std::move(r));
        }
    }

    Sketch sketch_;
    std::vector<Rational> spans_;
};

}  // namespace csgrt::oracle
