// A floating-point filter for intersect(): the same answer in a fraction of the time where doubles with error bounds
// (filter_numbers.hpp) decide everything, and no answer otherwise. The caller then asks intersect(), in 113 bits.
//
// The steps are those of intersect(): whether the ray comes near the solid, between which planes it runs, which roots
// each curved surface has, and how far rounding may shift each of them. There is no answer if any of this is not
// certain by a margin of its own error: an end beside an edge or a rim, a root that is nearly double, two surfaces that
// rounding may swap, a ray that runs in a face. So a filtered answer is never a tie, it has the intervals of the
// 113-bit answer, and its ends are refined to some 100 bits. Doubles in an Answer (tolerances, cosines) are right to
// some 10^-8 of themselves, normals to `normal_error`.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "filtered_pieces.hpp"
#include "certified_roots.hpp"

namespace csgrt::oracle {

inline constexpr double normal_error = 1e-14;  ///< largest difference of a filtered answer's normals from the true ones

class FilteredSolid {
public:
    explicit FilteredSolid(std::shared_ptr<const ImplicitSolid> solid) : solid_(std::move(solid)) {
        const ImplicitSolid& s = *solid_;
        if (s.surfaces.size() == 1) hull_ = s.surfaces[0]->pieces();
        pieces_ = filtered_pieces(s, hull_);
        columns_ = {triple<BoundedDouble>(s.to_local.x), triple<BoundedDouble>(s.to_local.y),
                    triple<BoundedDouble>(s.to_local.z)};
        fine_columns_ = {triple<DoubleDouble>(s.to_local.x), triple<DoubleDouble>(s.to_local.y),
                         triple<DoubleDouble>(s.to_local.z)};
        origin_ = triple<DoubleDouble>(s.to_local.origin);
        center_ = triple<DoubleDouble>(s.center);
        const QAffine most = componentwise_absolute(s.to_local);
        const QVec rows = most.direction({1, 1, 1});
        largest_ = to_double(larger(larger(rows.x, rows.y), rows.z));
        farthest_ = to_double(larger(larger(most.origin.x, most.origin.y), most.origin.z));
    }
    FilteredSolid(const FilteredSolid&) = delete;
    FilteredSolid& operator=(const FilteredSolid&) = delete;

    std::optional<Answer> operator()(const Ray& ray) const {
        Path path;
        if (pieces_.empty() || !begin(ray, path)) return {};
        Answer answer;
        answer.delta = path.delta;
        if (path.misses) return answer;
        Intervals found, within;
        for (const FilteredPiece& piece : pieces_) {
            within.clear();
            if (!between_planes(path, piece, within)) return {};
            for (const FilteredCurve& curve : piece.curves)
                if (!within.empty() && !cut(path, curve, within)) return {};
            if (!unite(within, found)) return {};
        }
        for (const auto& [in, out] : found)
            if (!finish(ray, path, in, out, answer)) return {};
        return answer;
    }

private:
    using Path = detail::FilteredRay;
    using Bound = detail::FilteredBound;
    using Intervals = detail::FilteredIntervals;

    // ---- Each of these returns false if something is not certain ----

    bool begin(const Ray& ray, Path& path) const {
        const ImplicitSolid& s = *solid_;
        const Triple<DoubleDouble> o = triple<DoubleDouble>(ray.origin), d = triple<DoubleDouble>(ray.direction);
        const Triple<DoubleDouble> to_center = center_ - o;
        const DoubleDouble square = dot(d, d);
        if (!(square.high > 1e-200 && square.high < 1e200)) return false;
        path.way = ray.direction;
        path.closest = dot(to_center, d) / square;
        path.speed = std::sqrt(square.high);
        const Triple<DoubleDouble> at = o + path.closest * d, off = center_ - at;
        const double way = std::abs(path.closest.high) * path.speed;
        const double span = s.bounded ? s.radius : std::max(s.size, std::sqrt(dot(to_center, to_center).high));
        path.reach = s.bounded ? 1.0625 : HUGE_VAL;
        path.unit = span / path.speed;
        path.delta = ulps * double_epsilon * s.condition * (s.placement + way + span);
        if (s.bounded) {
            const double miss = std::sqrt(dot(off, off).high), most = s.radius + margin * path.delta;
            path.misses = miss > 1.000000001 * most;
            if (path.misses) return true;
            if (!(miss < 0.999999999 * most)) return false;
        }
        const auto turned = [&](const Triple<DoubleDouble>& v) {
            return v.x * fine_columns_[0] + v.y * fine_columns_[1] + v.z * fine_columns_[2];
        };
        path.fine_origin = turned(at) + origin_;
        path.fine_direction = turned(DoubleDouble(path.unit) * d);
        // What rounding of some 2^-100 leaves of what cancels.
        const double far = std::abs(ray.origin.x) + std::abs(ray.origin.y) + std::abs(ray.origin.z) + way;
        const double left = 1e-29 * (largest_ * (far + span) + farthest_);
        const auto rough = [&](const DoubleDouble& x) {
            return BoundedDouble(x.high, BoundedDouble::unit_roundoff * std::abs(x.high) + left);
        };
        path.origin = {rough(path.fine_origin.x), rough(path.fine_origin.y), rough(path.fine_origin.z)};
        path.direction = {rough(path.fine_direction.x), rough(path.fine_direction.y), rough(path.fine_direction.z)};
        return std::isfinite(left);
    }

    /// The stretch between all planes, if there is one; the same planes decide its ends however rounding shifts them.
    bool between_planes(const Path& path, const FilteredPiece& piece, Intervals& within) const {
        Bound in = Bound::none(-path.reach), out = Bound::none(path.reach);
        std::array<Bound, 40> met;
        std::size_t count = 0;
        for (const FilteredPlane& plane : piece.planes) {
            const BoundedDouble at_zero = dot(plane.normal, path.origin) - plane.distance;
            const BoundedDouble rate = dot(plane.normal, path.direction);
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
            if (!(rate.least() > 1e8 * rate.error) || count == met.size()) return false;
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
                const double ahead = std::abs(end.at.v - bound.at.v), off = end.at.error + bound.at.error;
                if (!(ahead > 1.000001 * (std::abs(end.width - bound.width) + off))) return false;
            }
        }
        return within.add(in, out);
    }

    /// What of the intervals is within one more surface.
    bool cut(const Path& path, const FilteredCurve& curve, Intervals& within) const {
        const PolynomialOf<BoundedDouble> f = curve.surface->bounded_along(path.origin, path.direction);
        const double noise = curve.noise * (hull_.empty() ? 1 : curve.longest);
        const CertifiedRoots roots(f, -path.reach, path.reach,
                                   2 * margin * (1.75 * curve.steepest * path.delta + noise));
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
    bool root(const Path& path, const FilteredCurve& curve, const CertifiedRoot& found, Bound& bound) const {
        bound.at = found.at;
        bound.slope = found.slope;
        bound.curve = &curve;
        const Triple<BoundedDouble> point = path.origin + found.at * path.direction;
        const Triple<BoundedDouble> local = curve.surface->bounded_gradient(point);
        const Triple<BoundedDouble> g{dot(columns_[0], local), dot(columns_[1], local), dot(columns_[2], local)};
        bound.gradient = g;
        const double most = std::max({std::abs(g.x.v), std::abs(g.y.v), std::abs(g.z.v)});
        // Where the gradient all but vanishes more than it counts.
        if (!(most > 1e-6 * curve.steepest) || !(std::max({g.x.error, g.y.error, g.z.error}) < 1e-9 * most))
            return false;
        // A hull's function has a gradient of length 1 in its own frame.
        const double scale = hull_.empty()
                                 ? curve.surface->terms_at_in_double(point.x.v, point.y.v, point.z.v) / curve.terms
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
            const DoubleDouble t = path.closest + refined(path, bound) * DoubleDouble(path.unit);
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
    static bool runs_along(const Path& path, const FilteredPlane& plane) {
        const Vec3 &n = plane.outward, &d = path.way;
        return (n.x == 0 || d.x == 0) && (n.y == 0 || d.y == 0) && (n.z == 0 || d.z == 0);
    }

    // ---- Once it is certain ----

    /// One Newton step with a residual of 106 bits: from some 50 right bits to 100.
    static DoubleDouble refined(const Path& path, const Bound& bound) {
        if (const FilteredPlane* plane = bound.plane)
            return (plane->fine_distance - dot(plane->fine_normal, path.fine_origin)) /
                   dot(plane->fine_normal, path.fine_direction);
        const DoubleDouble at(bound.at.v);
        return at - bound.curve->surface->double_double_along(path.fine_origin, path.fine_direction)(at) /
                        DoubleDouble(bound.slope);
    }
    Vec3 normal(const Ray& ray, const Bound& bound, double steep, quad t) const {
        const Triple<BoundedDouble>& g = bound.gradient;
        if (std::max({g.x.error, g.y.error, g.z.error}) <= 0.7 * normal_error * steep)
            return {g.x.v / steep, g.y.v / steep, g.z.v / steep};
        const QVec local = solid_->to_local.point(QVec(ray.origin) + t * QVec(ray.direction));
        return to_vec3(unit(solid_->to_local.transposed(bound.curve->surface->gradient(local))));
    }
    static double length_of(const Triple<BoundedDouble>& v) {
        return std::sqrt(v.x.v * v.x.v + v.y.v * v.y.v + v.z.v * v.z.v);
    }

    std::shared_ptr<const ImplicitSolid> solid_;
    std::vector<SurfaceSet> hull_;
    std::vector<FilteredPiece> pieces_;
    std::array<Triple<BoundedDouble>, 3> columns_;  ///< of to_local
    std::array<Triple<DoubleDouble>, 3> fine_columns_;
    Triple<DoubleDouble> origin_, center_;
    double largest_ = 0, farthest_ = 0;  ///< the largest sum of a row of to_local, and of its translation
};

}  // namespace csgrt::oracle
