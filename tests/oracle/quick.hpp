// intersect.hpp's answer in a fraction of the time, where nothing is in doubt; else none, and intersect() is asked.
//
// The same steps in the same order of ideas, but in doubles that know how far off they may be (rough.hpp): whether the
// ray comes near the solid, between which planes it runs, which roots each curved surface has, and by how much rounding
// may shift every one. What is not certain by a margin of its own error gives no answer: an end beside an edge or a
// rim, a root that is nearly double, a surface within the doubt of another, a face that the ray runs in. So a quick
// answer is never a tie, its intervals are those of the 113-bit path, and its ends are refined to some 100 bits. What
// is a double in an Answer is right to some 10^-8 of itself (tolerances, cosines), normals to `normals_off`.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "quick_pieces.hpp"
#include "rough_roots.hpp"

namespace csgrt::oracle {

inline constexpr double normals_off = 1e-14;  ///< by what a quick answer's normals may differ from the true ones

class QuickSolid {
public:
    explicit QuickSolid(std::shared_ptr<const ImplicitSolid> solid) : solid_(std::move(solid)) {
        const ImplicitSolid& s = *solid_;
        if (s.surfaces.size() == 1) hull_ = s.surfaces[0]->pieces();
        pieces_ = quick_pieces(s, hull_);
        columns_ = {triple<Rough>(s.to_local.x), triple<Rough>(s.to_local.y), triple<Rough>(s.to_local.z)};
        fine_columns_ = {triple<Twofold>(s.to_local.x), triple<Twofold>(s.to_local.y), triple<Twofold>(s.to_local.z)};
        origin_ = triple<Twofold>(s.to_local.origin);
        center_ = triple<Twofold>(s.center);
        const QAffine most = componentwise_absolute(s.to_local);
        const QVec rows = most.direction({1, 1, 1});
        largest_ = to_double(larger(larger(rows.x, rows.y), rows.z));
        farthest_ = to_double(larger(larger(most.origin.x, most.origin.y), most.origin.z));
    }
    QuickSolid(const QuickSolid&) = delete;
    QuickSolid& operator=(const QuickSolid&) = delete;

    std::optional<Answer> operator()(const Ray& ray) const {
        Path path;
        if (pieces_.empty() || !begin(ray, path)) return {};
        Answer answer;
        answer.delta = path.delta;
        if (path.passes_by) return answer;
        Intervals found, within;
        for (const QuickPiece& piece : pieces_) {
            within.clear();
            if (!between_planes(path, piece, within)) return {};
            for (const QuickCurve& curve : piece.curves)
                if (!within.empty() && !cut(path, curve, within)) return {};
            if (!unite(within, found)) return {};
        }
        for (const auto& [in, out] : found)
            if (!finish(ray, path, in, out, answer)) return {};
        return answer;
    }

private:
    using Path = detail::QuickPath;
    using Bound = detail::QuickBound;
    using Intervals = detail::QuickIntervals;

    // ---- Each of these returns false if something is not certain ----

    bool begin(const Ray& ray, Path& path) const {
        const ImplicitSolid& s = *solid_;
        const Triple<Twofold> o = triple<Twofold>(ray.origin), d = triple<Twofold>(ray.direction);
        const Triple<Twofold> to_center = center_ - o;
        const Twofold square = dot(d, d);
        if (!(square.high > 1e-200 && square.high < 1e200)) return false;
        path.way = ray.direction;
        path.closest = dot(to_center, d) / square;
        path.speed = std::sqrt(square.high);
        const Triple<Twofold> at = o + path.closest * d, off = center_ - at;
        const double way = std::abs(path.closest.high) * path.speed;
        const double span = s.bounded ? s.radius : std::max(s.size, std::sqrt(dot(to_center, to_center).high));
        path.reach = s.bounded ? 1.0625 : HUGE_VAL;
        path.unit = span / path.speed;
        path.delta = ulps * double_epsilon * s.condition * (s.placement + way + span);
        if (s.bounded) {
            const double miss = std::sqrt(dot(off, off).high), most = s.radius + margin * path.delta;
            path.passes_by = miss > 1.000000001 * most;
            if (path.passes_by) return true;
            if (!(miss < 0.999999999 * most)) return false;
        }
        const auto turned = [&](const Triple<Twofold>& v) {
            return v.x * fine_columns_[0] + v.y * fine_columns_[1] + v.z * fine_columns_[2];
        };
        path.fine_origin = turned(at) + origin_;
        path.fine_direction = turned(Twofold(path.unit) * d);
        // What rounding of some 2^-100 leaves of what cancels.
        const double far = std::abs(ray.origin.x) + std::abs(ray.origin.y) + std::abs(ray.origin.z) + way;
        const double left = 1e-29 * (largest_ * (far + span) + farthest_);
        const auto rough = [&](const Twofold& x) {
            return Rough(x.high, Rough::unit_roundoff * std::abs(x.high) + left);
        };
        path.origin = {rough(path.fine_origin.x), rough(path.fine_origin.y), rough(path.fine_origin.z)};
        path.direction = {rough(path.fine_direction.x), rough(path.fine_direction.y), rough(path.fine_direction.z)};
        return std::isfinite(left);
    }

    /// The stretch between all planes, if there is one; the same planes decide its ends however rounding shifts them.
    bool between_planes(const Path& path, const QuickPiece& piece, Intervals& within) const {
        Bound in = Bound::none(-path.reach), out = Bound::none(path.reach);
        std::array<Bound, 40> met;
        std::size_t count = 0;
        for (const QuickPlane& plane : piece.planes) {
            const Rough at_zero = dot(plane.normal, path.origin) - plane.distance;
            const Rough rate = dot(plane.normal, path.direction);
            const double doubt = margin * plane.rate * path.delta;
            // Wholly on one side, as far as the solid reaches?
            if (solid_->bounded && at_zero.least() > 1.000001 * (rate.most() * path.reach + doubt)) {
                if (at_zero.v > 0) return true;
                continue;
            }
            if (!solid_->bounded && at_zero.least() > 1.000001 * doubt && runs_along(path, plane)) {
                if (at_zero.v > 0) return true;
                continue;
            }
            if (!(rate.least() > 1e8 * rate.off) || count == met.size()) return false;
            // An unbounded solid that the ray nearly runs along may be met anywhere.
            if (!solid_->bounded && !(rate.least() > 1e3 * doubt)) return false;
            Bound& bound = met[count++];
            bound.at = -at_zero / rate;
            bound.width = doubt / std::abs(rate.v) * (solid_->bounded ? 1 : 1 + std::abs(bound.at.v));
            bound.plane = &plane;
            bound.slope = rate.v;
            if (rate.v < 0 && bound.at.v > in.at.v) in = bound;
            if (rate.v > 0 && bound.at.v < out.at.v) out = bound;
        }
        if (in.is_beyond(out)) return true;
        if (!out.is_beyond(in)) return false;
        for (std::size_t i = 0; i < count; ++i) {
            const Bound &bound = met[i], &end = bound.slope < 0 ? in : out;
            if (end.plane == nullptr) {
                if (bound.may_be(end)) return false;
            } else if (bound.plane->same != end.plane->same) {
                const double ahead = std::abs(end.at.v - bound.at.v), off = end.at.off + bound.at.off;
                if (!(ahead > 1.000001 * (std::abs(end.width - bound.width) + off))) return false;
            }
        }
        return within.add(in, out);
    }

    /// What of the intervals is within one more surface.
    bool cut(const Path& path, const QuickCurve& curve, Intervals& within) const {
        const PolynomialOf<Rough> f = curve.surface->rough_along(path.origin, path.direction);
        const double noise = curve.noise * (hull_.empty() ? 1 : curve.longest);
        const RoughRoots roots(f, -path.reach, path.reach, 2 * margin * (1.75 * curve.steepest * path.delta + noise));
        if (!roots.certain()) return false;
        std::array<Bound, Polynomial::max_degree> bounds;
        for (std::size_t i = 0; i < roots.count(); ++i) {
            if (!root(path, curve, roots[i], bounds[i])) return false;
            if (i > 0 && !bounds[i].is_beyond(bounds[i - 1])) return false;
        }
        const Intervals before = within;
        within.clear();
        bool inside = roots.begins_inside();
        for (std::size_t i = 0; i <= roots.count(); ++i, inside = !inside) {
            if (!inside) continue;
            const Bound from = i > 0 ? bounds[i - 1] : Bound::none(-2 * path.reach);
            const Bound to = i < roots.count() ? bounds[i] : Bound::none(2 * path.reach);
            for (const auto& [in, out] : before) {
                if (from.may_be(out) || in.may_be(to)) return false;
                if (from.is_beyond(out) || in.is_beyond(to)) continue;
                if (from.may_be(in) || to.may_be(out)) return false;
                if (!within.add(from.is_beyond(in) ? from : in, out.is_beyond(to) ? to : out)) return false;
            }
        }
        return true;
    }
    bool root(const Path& path, const QuickCurve& curve, const RoughRoot& found, Bound& bound) const {
        bound.at = found.at;
        bound.slope = found.slope;
        bound.curve = &curve;
        const Triple<Rough> point = path.origin + found.at * path.direction;
        const Triple<Rough> local = curve.surface->rough_gradient(point);
        const Triple<Rough> g{dot(columns_[0], local), dot(columns_[1], local), dot(columns_[2], local)};
        bound.gradient = g;
        const double most = std::max({std::abs(g.x.v), std::abs(g.y.v), std::abs(g.z.v)});
        // Where the gradient all but vanishes more than it counts.
        if (!(most > 1e-6 * curve.steepest) || !(std::max({g.x.off, g.y.off, g.z.off}) < 1e-9 * most)) return false;
        // A hull's function has a gradient of length 1 in its own frame.
        const double scale = hull_.empty() ? curve.surface->rough_terms_at(point.x.v, point.y.v, point.z.v) / curve.terms
                                           : length_of(local);
        bound.blur = curve.blur * scale;
        const double doubt = margin * (1.75 * most * path.delta + curve.noise * scale);
        bound.width = doubt / std::abs(bound.slope);
        return bound.width < 0.9e-3 * path.reach;
    }

    /// Adds to a union that is convex: one interval, if any.
    static bool unite(const Intervals& more, Intervals& found) {
        if (more.empty()) return true;
        if (found.empty()) {
            found = more;
            return true;
        }
        if (found.count > 1 || more.count > 1) return false;
        auto& [in, out] = found.all[0];
        const auto& [from, to] = more.all[0];
        if (!to.is_beyond(in) || !out.is_beyond(from) || in.may_be(from) || out.may_be(to)) return false;
        if (in.is_beyond(from)) in = from;
        if (to.is_beyond(out)) out = to;
        return true;
    }

    bool finish(const Ray& ray, const Path& path, const Bound& in, const Bound& out, Answer& answer) const {
        const ImplicitSolid& s = *solid_;
        const double moved = precision * s.condition * s.size + margin * answer.delta;
        Interval interval;
        Span inner{{-infinity(), -1}, {infinity(), -1}}, outer = inner;
        for (const bool is_in : {true, false}) {
            const Bound& bound = is_in ? in : out;
            End& end = is_in ? interval.in : interval.out;
            if (bound.plane == nullptr && bound.curve == nullptr) {
                if (s.bounded) return false;
                end.t = is_in ? -HUGE_VAL : HUGE_VAL;
                continue;
            }
            const Twofold t = path.closest + refined(path, bound) * Twofold(path.unit);
            const quad exact = t.exactly(), width = bound.width * path.unit;
            end.t = t.high;
            const double span = path.unit * path.speed;
            const double steep = bound.plane != nullptr ? bound.plane->steep : length_of(bound.gradient);
            end.cosine = std::abs(bound.slope) / (steep * span);
            end.normal = bound.plane != nullptr ? bound.plane->outward : normal(ray, bound, steep, exact);
            end.blur = bound.blur < steep * s.size ? bound.blur / steep : s.size;
            const double other = bound.width * span * moved / (margin * answer.delta);
            double along_ray = std::max((moved + end.blur) / end.cosine, other);
            if (s.bounded) along_ray = std::min(along_ray, s.size);
            end.tolerance = along_ray / path.speed + 4 * double_epsilon * std::abs(end.t);
            if (!std::isfinite(end.t) || !(end.cosine > 0)) return false;
            (is_in ? inner.in : inner.out) = {is_in ? exact + width : exact - width, 0};
            (is_in ? outer.in : outer.out) = {is_in ? exact - width : exact + width, 0};
        }
        answer.intervals.push_back(interval);
        answer.inner.push_back(inner);
        answer.outer.push_back(outer);
        return true;
    }

    /// Do zeros keep the ray parallel to the plane, whatever is rounded?
    static bool runs_along(const Path& path, const QuickPlane& plane) {
        const Vec3 &n = plane.outward, &d = path.way;
        return (n.x == 0 || d.x == 0) && (n.y == 0 || d.y == 0) && (n.z == 0 || d.z == 0);
    }

    // ---- Once it is certain ----

    /// One Newton step with a residual of 106 bits: from some 50 right bits to 100.
    static Twofold refined(const Path& path, const Bound& bound) {
        if (const QuickPlane* plane = bound.plane)
            return (plane->fine_distance - dot(plane->fine_normal, path.fine_origin)) /
                   dot(plane->fine_normal, path.fine_direction);
        const Twofold at(bound.at.v);
        return at - bound.curve->surface->fine_along(path.fine_origin, path.fine_direction)(at) / Twofold(bound.slope);
    }
    Vec3 normal(const Ray& ray, const Bound& bound, double steep, quad t) const {
        const Triple<Rough>& g = bound.gradient;
        if (std::max({g.x.off, g.y.off, g.z.off}) <= 0.7 * normals_off * steep)
            return {g.x.v / steep, g.y.v / steep, g.z.v / steep};
        const QVec local = solid_->to_local.point(QVec(ray.origin) + t * QVec(ray.direction));
        return to_vec3(unit(solid_->to_local.transposed(bound.curve->surface->gradient(local))));
    }
    static double length_of(const Triple<Rough>& v) { return std::sqrt(v.x.v * v.x.v + v.y.v * v.y.v + v.z.v * v.z.v); }

    std::shared_ptr<const ImplicitSolid> solid_;
    std::vector<SurfaceSet> hull_;
    std::vector<QuickPiece> pieces_;
    std::array<Triple<Rough>, 3> columns_;  ///< of to_local
    std::array<Triple<Twofold>, 3> fine_columns_;
    Triple<Twofold> origin_, center_;
    double largest_ = 0, farthest_ = 0;  ///< the largest sum of a row of to_local, and of its translation
};

}  // namespace csgrt::oracle
