// A sketch turned about an axis. A line sweeps a cone, an arc a torus, both met by the roots of their textbook
// equations in the ray's parameter; Bezier curves and B-splines are met by those of f(t) = rho(curve)^2 - rho(ray)^2 at
// the curve's height. Ends of the outline that meet no other are joined to the axis, straight across.
#pragma once

#include <map>
#include <memory>
#include <utility>

#include "extruded.hpp"

namespace csgrt::oracle {

/// The sketch with its open ends joined to the axis.
inline Sketch closed_to_axis(Sketch sketch) {
    std::map<std::pair<double, double>, int> ends;
    const auto end = [&](std::uint32_t i) { ++ends[{sketch.vertices[i].u, sketch.vertices[i].v}]; };
    for (const Sketch::Curve& curve : sketch.curves) {
        if (const auto* line = std::get_if<Sketch::Line>(&curve)) end(line->start), end(line->end);
        if (const auto* arc = std::get_if<Sketch::Arc>(&curve))
            if (arc->radius > 0) end(arc->start), end(arc->end);
        if (const auto* bezier = std::get_if<Sketch::Bezier>(&curve))
            end(bezier->points.front()), end(bezier->points.back());
        if (const auto* nurb = std::get_if<Sketch::Nurb>(&curve)) end(nurb->points.front()), end(nurb->points.back());
    }
    for (const auto& [p, count] : ends) {
        if (count % 2 == 0 || p.first == 0) continue;
        const auto next = static_cast<std::uint32_t>(sketch.vertices.size());
        sketch.vertices.push_back({p.first, p.second});
        sketch.vertices.push_back({0, p.second});
        sketch.curves.push_back(Sketch::Line{next, next + 1});
    }
    return sketch;
}

/// The crossings of a ray with what the curves of an outline sweep all round, in the frame of the axis.
class TurnedOutline {
public:
    explicit TurnedOutline(const Sketch& sketch) : outline_(closed_to_axis(sketch)) {
        for (const Sketch::Curve& curve : outline_.sketch().curves)
            if (const auto* bezier = std::get_if<Sketch::Bezier>(&curve))
                rationals_.push_back(Outline::bezier(outline_.sketch(), *bezier));
        rationals_.insert(rationals_.end(), outline_.spans().begin(), outline_.spans().end());
    }

    /// Unsorted; normals are in the frame of the axis, of any length and sense. Nothing lies farther than `reach`
    /// from the origin of the frame.
    std::vector<ExactEnd> crossings(const QVec& o, const QVec& d, quad reach) const {
        Crosser c{o, d, reach, outline_.sketch(), {}};
        for (const Sketch::Curve& curve : outline_.sketch().curves)
            std::visit([&](const auto& one) { c.curve(one); }, curve);
        for (const Outline::Rational& r : rationals_) c.rational(r);
        return std::move(c.found);
    }

private:
    struct Crosser {
        const QVec o, d;
        const quad reach;
        const Sketch& sketch;
        std::vector<ExactEnd> found;

        QVec at(quad t) const { return o + t * d; }
        static quad rho(const QVec& p) { return root(p.x * p.x + p.y * p.y); }
        /// `across`, `along`: the curve's normal in the half plane.
        void add(quad t, quad across, quad along) {
            const QVec p = at(t);
            const quad r = rho(p);
            found.push_back({t, r > 0 ? QVec{across * p.x / r, across * p.y / r, along} : QVec{0, 0, along}});
        }
        Coefficients x() const { return {o.x, d.x}; }
        Coefficients y() const { return {o.y, d.y}; }
        Coefficients z() const { return {o.z, d.z}; }
        Coefficients rho2() const { return sum(product(x(), x()), 1, product(y(), y())); }
        std::vector<quad> roots_near(const Coefficients& c) const {
            const quad middle = -dot(o, d) / dot(d, d), half = quad(1.25) * reach / length(d);
            return changes_of_sign(c, middle - half, middle + half);
        }

        void curve(const Sketch::Line& line) {
            const QVec p = Outline::point(sketch, line.start), q = Outline::point(sketch, line.end);
            if (p.y == q.y) {
                if (d.z == 0) return;
                const quad t = (p.y - o.z) / d.z, r = rho(at(t));
                if ((p.x > r) != (q.x > r)) add(t, 0, 1);
                return;
            }
            const quad slope = (q.x - p.x) / (q.y - p.y);
            const Coefficients radius = sum({p.x - slope * p.y}, slope, z());
            for (const quad t : roots_near(sum(product(radius, radius), -1, rho2()))) {
                const quad height = at(t).z;
                if ((height > p.y) != (height > q.y)) add(t, 1, -slope);
            }
        }
        void curve(const Sketch::Arc& arc) {
            const auto circle = Outline::circle(sketch, arc);
            const Coefficients height = sum(z(), -circle.center.y, {1});
            const quad u = circle.center.x;
            // rho^2 + u^2 + h^2 - R^2 = +- 2 u rho; minus is the mirrored circle.
            const Coefficients left =
                sum(sum(rho2(), 1, product(height, height)), u * u - circle.radius * circle.radius, {1});
            const bool on_axis = u == 0;
            for (const quad t : roots_near(on_axis ? left : sum(product(left, left), -4 * u * u, rho2()))) {
                const QVec p = at(t);
                const QVec in_half_plane{rho(p), p.z, 0};
                if (!on_axis && (value_at(left, t) < 0) != (u < 0)) continue;
                if (Outline::on_arc(sketch, arc, in_half_plane))
                    add(t, in_half_plane.x - u, in_half_plane.y - circle.center.y);
            }
        }
        void curve(const Sketch::Bezier&) {}
        void curve(const Sketch::Nurb&) {}

        void rational(const Outline::Rational& r) {
            const Coefficients above = sum(r.y, -o.z, r.w);
            const auto hit = [&](quad k, quad t) {
                const quad px = value_at(r.x, k), py = value_at(r.y, k), w = value_at(r.w, k);
                const quad xs = value_at(derivative_of(r.x), k), ys = value_at(derivative_of(r.y), k),
                           ws = value_at(derivative_of(r.w), k);
                add(t, ys * w - py * ws, px * ws - xs * w);
            };
            if (absolute(d.z) <= quad(1e-13) * length(d)) {
                // The ray stays at its height as far as the solid goes.
                const quad flat2 = d.x * d.x + d.y * d.y, middle = -(o.x * d.x + o.y * d.y) / flat2;
                const QVec nearest = at(middle);
                for (const quad k : changes_of_sign(sum(r.y, -nearest.z, r.w), r.low, r.high)) {
                    const quad radius = value_at(r.x, k) / value_at(r.w, k);
                    const quad half2 = (radius * radius - nearest.x * nearest.x - nearest.y * nearest.y) / flat2;
                    if (!(half2 > 0)) continue;
                    for (const quad t : {middle - root(half2), middle + root(half2)}) hit(k, t);
                }
                return;
            }
            const Coefficients radius = sum({}, d.z, r.x);
            const Coefficients across = sum(sum({}, d.z * o.x, r.w), d.x, above);
            const Coefficients aside = sum(sum({}, d.z * o.y, r.w), d.y, above);
            const Coefficients f =
                sum(sum(product(radius, radius), -1, product(across, across)), -1, product(aside, aside));
            for (const quad k : changes_of_sign(f, r.low, r.high))
                hit(k, value_at(above, k) / (d.z * value_at(r.w, k)));
        }
    };

    Outline outline_;
    std::vector<Outline::Rational> rationals_;
};

inline ExactSolid revolved(const Revolve& shape, const QAffine& place) {
    const QVec axis = unit(shape.axis), given = shape.r;
    const QVec x = unit(given - dot(given, axis) * axis);
    ImplicitSolid frame;
    add_frame(frame, place, {x, cross(axis, x), axis, shape.v});
    const QAffine to_world = frame.to_world, to_local = frame.to_local;

    ExactSolid solid;
    solid.frame = to_world;
    solid.condition = frame.condition;
    quad low = shape.sketch.vertices[0].v, high = low, wide = 0;
    for (const Sketch::Curve& curve : shape.sketch.curves) {
        const auto* arc = std::get_if<Sketch::Arc>(&curve);
        if (!arc) continue;
        const auto c = Outline::circle(shape.sketch, *arc);  // tests have none of large radius
        low = smaller(low, c.center.y - c.radius), high = larger(high, c.center.y + c.radius);
        wide = larger(wide, c.center.x + c.radius);
    }
    for (const Sketch::Point& p : shape.sketch.vertices)
        low = smaller(low, p.v), high = larger(high, p.v), wide = larger(wide, p.u);
    const quad half = (high - low) / 2, middle = (high + low) / 2;
    solid.center = to_world.point({0, 0, middle});
    solid.radius =
        to_double(wide * root(dot(to_world.x, to_world.x) + dot(to_world.y, to_world.y)) + half * length(to_world.z));
    const QAffine rounding =
        componentwise_absolute(place) * componentwise_absolute(QAffine{x, cross(axis, x), axis, shape.v});
    solid.placement = to_double(length(rounding.point({wide, wide, larger(absolute(low), absolute(high))})));

    const quad reach = wide + absolute(middle) + half;
    // Two half planes that are less than the limit of coincidence apart, 1e-10, are one: the documented rule.
    constexpr long double pi = 3.14159265358979323846264338327950288L, limit = 1e-10L;
    const bool whole = shape.angle >= 2 * pi - limit, nothing = shape.angle <= limit;
    const bool is_half = fabsl(shape.angle - pi) <= limit, at_most_half = is_half || shape.angle < pi;
    const QVec turned = is_half ? QVec{-1, 0, 0} : QVec{cosl(shape.angle), sinl(shape.angle), 0};
    if (!whole && !nothing) solid.half_way = QVec{cosl(shape.angle / 2), sinl(shape.angle / 2), 0};
    solid.along = [=, outline = std::make_shared<TurnedOutline>(shape.sketch)](const QVec& world_o,
                                                                               const QVec& world_d) -> ExactIntervals {
        if (nothing) return {};
        const QVec o = to_local.point(world_o), d = to_local.direction(world_d);
        struct Event {
            ExactEnd end;
            bool outline;
        };
        std::vector<Event> events;
        const auto add = [&](const ExactEnd& end, bool of_outline) {
            const QVec n = to_local.transposed(end.normal);
            events.push_back({{end.t, dot(n, n) > 0 ? unit(n) : n}, of_outline});
        };
        for (const ExactEnd& end : outline->crossings(o, d, reach)) add(end, true);
        if (!whole) {
            for (const QVec& face : {QVec{1, 0, 0}, turned}) {
                const QVec n{-face.y, face.x, 0};
                if (dot(n, d) != 0) add({-dot(n, o) / dot(n, d), n}, false);
            }
        }
        std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.end.t < b.end.t; });
        // Between the half planes of the two faces, counterclockwise from the first.
        const auto in_turn = [&](const QVec& p) {
            if (whole) return true;
            const bool left = p.y > 0, right_of_end = turned.x * p.y - turned.y * p.x < 0;
            return at_most_half ? left && right_of_end : left || right_of_end;
        };
        ExactIntervals intervals;
        bool odd = false, inside = false;
        for (std::size_t i = 0; i < events.size(); ++i) {
            odd = odd != events[i].outline;
            const bool last = i + 1 == events.size();
            const bool now = odd && !last && in_turn(o + (events[i].end.t + events[i + 1].end.t) / 2 * d);
            if (now && !inside) intervals.push_back({events[i].end, {}});
            if (!now && inside) intervals.back().out = events[i].end;
            inside = now;
        }
        std::erase_if(intervals, [](const ExactInterval& i) { return !(i.in.t < i.out.t); });
        return detail::outward(intervals, world_d);
    };
    return solid;
}

}  // namespace csgrt::oracle
