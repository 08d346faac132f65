#include "intersect.hpp"

#include <algorithm>
#include <utility>

namespace csgrt::oracle {

namespace {

struct Sets {
    Spans inner, exact, outer;
    bool may_turn_back = false;  ///< rounding may add a pair of roots, be it within the doubt of another
};

/// A ray in a parameter s of its own: t = t_c + s unit, so that the solid lies within |s| <= 1.
struct ScaledRay {
    QVec origin, direction;  ///< own frame of the solid
    quad t_c = 0, unit = 1;
    quad reach = 0;  ///< |s| up to which the solid can reach; infinity for unbounded ones
    quad turn = 0;   ///< by how much the direction's end can move when s is 1, in deltas
    QVec world_direction;
    std::vector<quad> look_at;

    /// How fast it comes nearer to a plane, in units of double's rounding, 2^-53.
    quad approach(const QVec& normal) const {
        return absolute(dot(normal, world_direction)) / length(world_direction) / quad(double_epsilon);
    }
};

/// A polynomial as a line that can be asked for its roots.
struct PolynomialLine {
    Polynomial f, derivative = f.derivative();

    quad operator()(quad s) const { return f(s); }
    quad slope(quad s) const { return derivative(s); }
    Roots crossings(quad level, quad low, quad high) const { return roots(f - Polynomial(level), low, high); }
    Roots turns(quad low, quad high) const { return roots(derivative, low, high); }
};

/// f <= 0 along the ray for surface k, which is not plane; `change_at(s)`: by how much f may be off there.
template <class Curve, class Change>
Sets solve_curve(const Curve& f, std::size_t k, const ScaledRay& ray, const Change& change_at) {
    const auto bound = [&](quad s) { return Bound{s, static_cast<int>(k)}; };
    Sets sets;
    const auto crossings = f.crossings(0, -ray.reach, ray.reach);
    const auto turns = f.turns(-ray.reach, ray.reach);
    quad from = -ray.reach;
    const auto stretch = [&](quad to) {
        // The sign between two roots: at the middle, or at an end of the range, whichever is farther from 0.
        quad most = from < to ? f((from + to) / 2) : quad(1);
        for (const quad end : {-ray.reach, ray.reach})
            if ((from == end || to == end) && absolute(f(end)) > absolute(most)) most = f(end);
        if (from < to && most <= 0) sets.exact.push_back({bound(from), bound(to)});
        from = to;
    };
    for (const quad s : crossings) stretch(s);
    stretch(ray.reach);
    sets.exact = join(std::move(sets.exact));

    // |f| <= e around s, where f stays within e of 0.
    const auto zone = [&](quad at, quad e) {
        Span span{bound(-ray.reach), bound(ray.reach)};
        for (const quad level : {e, -e})
            for (const quad x : f.crossings(level, -ray.reach, ray.reach)) {
                if (x <= at && x > span.in.at) span.in.at = x;
                if (x >= at && x < span.out.at) span.out.at = x;
            }
        return span;
    };
    Spans unsure;
    for (const quad s : crossings) {
        const quad e = change_at(s), steep = absolute(f.slope(s));
        const bool flat = e >= steep * ray.reach * quad(1e-3);
        unsure.push_back(flat ? zone(s, e) : Span{bound(s - e / steep), bound(s + e / steep)});
    }
    // Where f comes near to 0 without crossing it, it turns or the range ends.
    const auto look = [&](quad s) {
        const quad e = change_at(s);
        if (absolute(f(s)) <= e) unsure.push_back(zone(s, 2 * e));
    };
    for (const quad s : turns) look(s);
    // Where f turns back within the doubt of 0, beside a root at a tip, the doubt of the two is one stretch, in which
    // the number of roots is not sure.
    std::vector<quad> knots{-ray.reach};
    knots.insert(knots.end(), turns.begin(), turns.end());
    knots.push_back(ray.reach);
    for (std::size_t i = 1; i + 1 < knots.size(); ++i) {
        const quad here = f(knots[i]);
        const bool turns_back = (f(knots[i - 1]) > here) == (f(knots[i + 1]) > here);
        if (turns_back && absolute(here) <= change_at(knots[i])) sets.may_turn_back = true;
    }
    look(-ray.reach);
    look(ray.reach);
    unsure = join(std::move(unsure));
    sets.inner = subtract(sets.exact, unsure);
    sets.outer = unite(sets.exact, unsure);
    return sets;
}

/// f <= 0 along the ray for surface k.
Sets solve(const ImplicitSolid& solid, std::size_t k, const ScaledRay& ray, quad delta) {
    const auto change_with = [&](quad s, bool noisy) {
        const QVec p = ray.origin + s * ray.direction;
        const quad noise = noisy ? solid.noise(k, p) : quad(0);
        return quad(margin) * (solid.change(k, p, delta * (1 + ray.turn * absolute(s))) + noise);
    };
    if (const auto line = solid.surfaces[k]->ray_function(ray.origin, ray.direction)) {
        line->look_at(ray.look_at);
        return solve_curve(*line, k, ray, [&](quad s) { return change_with(s, true); });  // nothing but this bounds it
    }
    const Polynomial f = solid.surfaces[k]->along(ray.origin, ray.direction);
    const auto change_at = [&](quad s) { return change_with(s, f.degree > 2); };
    const auto bound = [&](quad s) { return Bound{s, static_cast<int>(k)}; };
    if (f.degree == 1) {
        Sets sets;
        const quad e = change_at(0), c0 = f.c[0], c1 = f.c[1];
        // Of a bounded solid: up to the rounding of 113 bits. Of a half-space: of the direction's and the normal's own
        // numbers. With some roundings more the slope is not sure.
        const quad approach = solid.bounded ? quad(0) : ray.approach(solid.normal(k, solid.center));
        const bool parallel = solid.bounded ? absolute(c1) <= e * quad(1e-12) : approach <= 8;
        const bool unsure_slope = parallel ? approach > 4 : absolute(c1) <= e * ray.turn;
        const quad end = parallel ? quad(0) : -c0 / c1;
        if (parallel)
            sets.exact = c0 <= 0 ? everything() : Spans{};
        else if (c1 > 0)
            sets.exact = {{{-infinity(), -1}, bound(end)}};
        else
            sets.exact = {{bound(end), {infinity(), -1}}};
        Spans unsure;
        if (!solid.bounded && unsure_slope) {
            unsure = everything();  // turned by its last bits the ray runs into the plane elsewhere, or never
        } else if (parallel) {
            if (absolute(c0) <= e) unsure = everything();
        } else {
            const quad w = (solid.bounded ? e : change_at(end)) / absolute(c1);
            unsure = {{bound(end - w), bound(end + w)}};
        }
        sets.inner = subtract(sets.exact, unsure);
        sets.outer = unite(sets.exact, unsure);
        return sets;
    }

    // A pair of roots beyond a plane, on a cone's other nappe, is none of the solid's.
    Sets sets = solve_curve(PolynomialLine{f}, k, ray, change_at);
    sets.may_turn_back = sets.may_turn_back && solid.surfaces.size() == 1 && f.degree > 2;
    return sets;
}

}  // namespace

Answer intersect(const ImplicitSolid& solid, const Ray& ray, const std::vector<double>& look_at) {
    const QVec o = ray.origin, d = ray.direction;
    const quad speed = length(d);
    const QVec to_center = solid.center - o;

    ScaledRay scaled;
    scaled.t_c = dot(to_center, d) / (speed * speed);
    const quad way = absolute(scaled.t_c) * speed;
    const quad span = solid.bounded ? quad(solid.radius) : larger(quad(solid.size), length(to_center));
    scaled.unit = span / speed;
    scaled.reach = solid.bounded ? quad(1.0625) : infinity();
    scaled.origin = solid.to_local.point(o + scaled.t_c * d);
    scaled.direction = solid.to_local.direction(scaled.unit * d);
    const quad rounding = quad(ulps * double_epsilon * solid.condition);
    const quad delta = rounding * (quad(solid.placement) + way + span);
    scaled.world_direction = d;
    for (const double t : look_at) scaled.look_at.push_back((quad(t) - scaled.t_c) / scaled.unit);
    // A bounded solid's delta covers the turn of the direction already: it is hit within its radius.
    scaled.turn = solid.bounded ? quad(0) : quad(1);

    Answer answer;
    answer.delta = to_double(delta);
    const quad miss = length(to_center - scaled.t_c * d);
    if (solid.bounded && miss > quad(solid.radius) + quad(margin) * delta) return answer;

    Sets sets{everything(), everything(), everything(), false};
    for (std::size_t k = 0; k < solid.surfaces.size() && !sets.outer.empty(); ++k) {
        const Sets one = solve(solid, k, scaled, delta);
        sets.inner = intersect(sets.inner, one.inner);
        sets.exact = intersect(sets.exact, one.exact);
        sets.outer = intersect(sets.outer, one.outer);
        sets.may_turn_back = sets.may_turn_back || one.may_turn_back;
    }
    if (solid.bounded) {
        const Spans within{{{-scaled.reach, -1}, {scaled.reach, -1}}};
        sets.inner = intersect(sets.inner, within);
        sets.exact = intersect(sets.exact, within);
        sets.outer = intersect(sets.outer, within);
    }
    answer.tie = sets.may_turn_back || !nested_one_to_one(sets.inner, sets.exact, sets.outer);

    const auto along = [&](quad s) { return absolute(s) < infinity() ? scaled.t_c + s * scaled.unit : s; };
    const auto end = [&](const Bound& bound) {
        End e;
        const quad t = along(bound.at);
        e.t = to_double(t);
        if (bound.surface < 0) return e;
        const auto k = static_cast<std::size_t>(bound.surface);
        const QVec n = solid.normal(k, o + t * d);
        e.blur = to_double(solid.blur(k, o + t * d));
        e.normal = to_vec3(n);
        e.cosine = to_double(absolute(dot(n, d)) / speed);
        return e;
    };
    const double moved = precision * solid.condition * solid.size + margin * answer.delta;
    const auto set_tolerance = [&](End& e, quad exact, quad inner, quad outer) {
        // By how much the end moves when every surface moves by margin x delta, and so by `moved`: also where a second
        // surface that is more nearly along the ray takes over, close to an edge.
        const quad gap = larger(absolute(exact - inner), absolute(exact - outer)) * scaled.unit * speed;
        const double other = answer.tie ? 0 : to_double(gap) * moved / (margin * answer.delta);
        double along_ray = std::max((moved + e.blur) / e.cosine, other);
        if (solid.bounded) along_ray = std::min(along_ray, solid.size);
        e.tolerance = along_ray / to_double(speed) + 4 * double_epsilon * std::abs(e.t);
    };
    for (std::size_t i = 0; i < sets.exact.size(); ++i) {
        const Span& exact = sets.exact[i];
        const Span& inner = answer.tie ? exact : sets.inner[i];
        const Span& outer = answer.tie ? exact : sets.outer[i];
        Interval interval{end(exact.in), end(exact.out)};
        if (exact.in.surface >= 0) set_tolerance(interval.in, exact.in.at, inner.in.at, outer.in.at);
        if (exact.out.surface >= 0) set_tolerance(interval.out, exact.out.at, inner.out.at, outer.out.at);
        answer.intervals.push_back(interval);
    }
    for (Spans* spans : {&sets.inner, &sets.outer})
        for (Span& s : *spans) {
            s.in.at = along(s.in.at);
            s.out.at = along(s.out.at);
        }
    answer.inner = std::move(sets.inner);
    answer.outer = std::move(sets.outer);
    return answer;
}

}  // namespace csgrt::oracle
