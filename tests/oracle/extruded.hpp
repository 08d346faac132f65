// An outline moved along a line: a point v + x a + y b + z h is inside if 0 <= z <= 1 and the outline holds (x, y).
#pragma once

#include <memory>

#include "outline.hpp"
#include "perturbation.hpp"

namespace csgrt::oracle {

namespace detail {

/// The stretches of a line with an odd number of crossings before them, within [low, high].
inline ExactIntervals between(const std::vector<ExactEnd>& crossings, const ExactEnd& low, const ExactEnd& high) {
    ExactIntervals intervals;
    bool inside = false;
    ExactEnd from = low;
    const auto to = [&](const ExactEnd& end) {
        const ExactEnd in = from.t < low.t ? low : from, out = end.t < high.t ? end : high;
        if (inside && in.t < out.t) intervals.push_back({in, out});
        from = end;
        inside = !inside;
    };
    for (const ExactEnd& end : crossings) to(end);
    if (inside) to(high);
    return intervals;
}

/// Normals of the two sides of each interval point against the ray and with it.
inline ExactIntervals outward(ExactIntervals intervals, const QVec& d) {
    for (ExactInterval& i : intervals) {
        if (dot(i.in.normal, d) > 0) i.in.normal = -i.in.normal;
        if (dot(i.out.normal, d) < 0) i.out.normal = -i.out.normal;
    }
    return intervals;
}

}  // namespace detail

inline ExactSolid extruded(const Extrude& shape, const QAffine& place) {
    ImplicitSolid frame;
    add_frame(frame, place, {shape.a, shape.b, shape.h, shape.v});
    const QAffine to_world = frame.to_world, to_local = frame.to_local;
    const auto outline = std::make_shared<Outline>(shape.sketch);

    ExactSolid solid;
    solid.frame = to_world;
    solid.condition = frame.condition;
    QVec low, high;
    bool first = true;
    for (const Sketch::Curve& curve : shape.sketch.curves) {
        const auto reach = [&](const QVec& p, quad r) {
            const QVec a = p - QVec{r, r, 0}, b = p + QVec{r, r, 0};
            low = first ? a : QVec{smaller(low.x, a.x), smaller(low.y, a.y), 0};
            high = first ? b : QVec{larger(high.x, b.x), larger(high.y, b.y), 1};
            high.z = 1;
            first = false;
        };
        if (const auto* arc = std::get_if<Sketch::Arc>(&curve)) {
            const auto c = Outline::circle(shape.sketch, *arc);
            // No farther than the circle, and no farther than a half circle over the chord, or the circle's diameter.
            const QVec p = Outline::point(shape.sketch, arc->start), q = Outline::point(shape.sketch, arc->end);
            arc->radius < 0 ? reach(c.center, c.radius)
                            : reach(p, larger(length(q - p), smaller(2 * c.radius, 4 * length(q - p))));
        }
        for (const Sketch::Point& p : shape.sketch.vertices) reach({p.u, p.v, 0}, 0);
    }
    solid.center = to_world.point(quad(0.5) * (low + high));
    const QVec half = quad(0.5) * (high - low);
    solid.radius = to_double(length(half.x * to_world.x) + length(half.y * to_world.y) + length(half.z * to_world.z));
    const QAffine rounding =
        componentwise_absolute(place) * componentwise_absolute(QAffine{shape.a, shape.b, shape.h, shape.v});
    solid.placement = to_double(length(
        rounding.point({larger(absolute(low.x), absolute(high.x)), larger(absolute(low.y), absolute(high.y)), 1})));

    solid.along = [=](const QVec& world_o, const QVec& world_d) -> ExactIntervals {
        const QVec o = to_local.point(world_o), d = to_local.direction(world_d);
        const auto normal = [&](const QVec& n) {
            const QVec w = to_local.transposed(n);
            return dot(w, w) > 0 ? unit(w) : w;
        };
        ExactEnd in{-quad(1e300), {}}, out{quad(1e300), {}};
        const QVec cap = normal({0, 0, 1});
        if (d.z != 0) {
            in = {-o.z / d.z, cap}, out = {(1 - o.z) / d.z, cap};
            if (out.t < in.t) std::swap(in, out);
        } else if (o.z < 0 || o.z > 1) {
            return {};
        }
        std::vector<ExactEnd> ends;
        if (d.x * d.x + d.y * d.y > quad(1e-60) * dot(d, d)) {
            for (const PlaneCrossing& c : outline->crossings(o, d)) ends.push_back({c.at, normal(c.normal)});
        } else if (outline->contains(o)) {
            ends = {in, out};
        }
        return detail::outward(detail::between(ends, in, out), world_d);
    };
    return solid;
}

}  // namespace csgrt::oracle
