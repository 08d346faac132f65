// intersect.hpp's answer in a fraction of the time, where nothing is in doubt; else none, and intersect() is asked.
//
// The same steps in the same order of ideas, but in doubles that know how far off they may be (rough.hpp): whether the
// ray comes near the solid, between which planes it runs, which roots each curved surface has, and by how much rounding
// may shift every one. What is not certain by a margin of its own error gives no answer: an end beside an edge or a
// rim, a root that is nearly double, a surface within the doubt of another, a face that the ray runs in. So a quick
// answer is never a tie, its intervals are those of the 113-bit path, and its ends are refined to some 100 bits. What
// is a double in an Answer (tolerances, cosines, normals) is right to some 10^-9 of itself, normals to 4 10^-15.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "intersect.hpp"
#include "rough_roots.hpp"

namespace csgrt::oracle {

class QuickSolid {
public:
    explicit QuickSolid(std::shared_ptr<const ImplicitSolid> solid) : solid_(std::move(solid)) {
        const ImplicitSolid& s = *solid_;
        matrix_ = {triple<Twofold>(s.to_local.x), triple<Twofold>(s.to_local.y), triple<Twofold>(s.to_local.z)};
        origin_ = triple<Twofold>(s.to_local.origin);
        center_ = triple<Twofold>(s.center);
        columns_ = {triple<Rough>(s.to_local.x), triple<Rough>(s.to_local.y), triple<Rough>(s.to_local.z)};
        const QAffine rows = componentwise_absolute(s.to_local);
        largest_ = to_double(larger(larger(rows.x.x + rows.y.x + rows.z.x, rows.x.y + rows.y.y + rows.z.y),
                                    rows.x.z + rows.y.z + rows.z.z));
        farthest_ = to_double(larger(larger(rows.origin.x, rows.origin.y), rows.origin.z));
        usable_ =
            std::isfinite(largest_) && std::isfinite(farthest_) && s.size > 0 && (s.bounded ? s.radius > 0 : true);
        for (std::size_t k = 0; k < s.surfaces.size() && usable_; ++k) add(k);
        if (!s.bounded) usable_ = usable_ && planes_.size() == 1 && curves_.empty();
    }

    std::optional<Answer> operator()(const Ray& ray) const {
        if (!usable_) return {};
        Path path;
        if (!begin(ray, path)) return {};
        if (path.passes_by) return nothing(path);
        Ends ends;
        if (!between_planes(path, ends)) return {};
        if (ends.misses) return nothing(path);
        Intervals found{{ends.in, ends.out}};
        for (const Curve& curve : curves_) {
            if (!cut(path, curve, found)) return {};
            if (found.empty()) return nothing(path);
        }
        Answer answer = nothing(path);
        for (const auto& [in, out] : found)
            if (!finish(ray, path, in, out, answer)) return {};
        return answer;
    }

private:
    struct Plane {
        std::size_t k = 0;
        Triple<Rough> normal;
        Rough distance;
        Triple<Twofold> fine_normal;
        Twofold fine_distance;
        double rate = 0;   ///< by how much its function changes, at most, when a point moves by 1 mm
        double steep = 0;  ///< its gradient's length in the world
        Vec3 outward;
        std::size_t same = 0;  ///< the first plane that is the same one
    };
    struct Curve {
        std::size_t k = 0;
        double noise = 0;     ///< that counts where it changes sign: quartics'
        double blur = 0;      ///< that counts where it is
        double steepest = 0;  ///< the longest component of its gradient in the world near the solid, and more
    };
    /// The ray in a parameter s: t = closest + s unit, as in intersect.hpp.
    struct Path {
        Twofold closest;
        double unit = 1, speed = 1, delta = 0, reach = 0;
        Triple<Twofold> fine_origin, fine_direction;
        Triple<Rough> origin, direction;
        bool passes_by = false;
    };
    struct Bound {
        Rough at;
        double width = 0;        ///< rounding may shift it by this
        int surface = -1;        ///< -1: none, it is infinite or a ball's
        Triple<Rough> gradient;  ///< of a curved surface, in the world
        double slope = 0;        ///< of a curved surface's function along s

        /// Farther along than `other` by more than they may be off, for certain?
        bool is_beyond(const Bound& other) const {
            return at.v - other.at.v > 1.000001 * (at.off + other.at.off + width + other.width);
        }
        bool may_be(const Bound& other) const { return !is_beyond(other) && !other.is_beyond(*this); }
    };
    using Intervals = std::vector<std::pair<Bound, Bound>>;
    struct Ends {
        Bound in, out;
        bool misses = false;
    };

    static double length_of(const Triple<Rough>& v) { return std::sqrt(v.x.v * v.x.v + v.y.v * v.y.v + v.z.v * v.z.v); }
    static Answer nothing(const Path& path) {
        Answer answer;
        answer.delta = path.delta;
        return answer;
    }

    void add(std::size_t k) {
        const Surface& surface = *solid_->surfaces[k];
        const QAffine& back = solid_->to_local;
        if (!surface.is_polynomial()) {
            usable_ = false;
            return;
        }
        if (surface.along({}, {1, 1, 1}).degree == 1) {
            Plane plane;
            const QVec n = surface.gradient({});
            const quad distance = -surface.value({});
            plane.k = k;
            plane.normal = triple<Rough>(n);
            plane.distance = Rough(distance);
            plane.fine_normal = triple<Twofold>(n);
            plane.fine_distance = Twofold(distance);
            quad most = 0;
            for (const QVec& axis : {back.x, back.y, back.z}) most = larger(most, absolute(dot(n, axis)));
            plane.rate = 1.75 * to_double(most);
            plane.steep = to_double(length(back.transposed(n)));
            plane.outward = to_vec3(solid_->normal(k, solid_->center));
            plane.same = k;
            for (const Plane& other : planes_)
                if (is_same(surface, *solid_->surfaces[other.k])) plane.same = std::min(plane.same, other.same);
            usable_ = usable_ && plane.steep > 0;
            planes_.push_back(plane);
            return;
        }
        Curve curve;
        curve.k = k;
        curve.blur = to_double(solid_->noise(k));
        if (surface.along({}, {1, 1, 1}).degree > 2) curve.noise = curve.blur;
        // Where it is asked about it is within 1.5 radii. Its components are cubic at most, so what 27 points do not
        // show is less than three times what they do.
        for (const double x : {-1, 0, 1})
            for (const double y : {-1, 0, 1})
                for (const double z : {-1, 0, 1}) {
                    const QVec p = solid_->center + quad(1.5 * solid_->radius) * QVec(x, y, z);
                    const QVec g = back.transposed(surface.gradient(back.point(p)));
                    for (const quad component : {g.x, g.y, g.z})
                        curve.steepest = std::max(curve.steepest, 3 * to_double(absolute(component)));
                }
        usable_ = usable_ && std::isfinite(curve.steepest) && curve.steepest > 0;
        curves_.push_back(curve);
    }
    /// Up to the rounding of 113 bits. Arbs have their box's planes, which most often are their faces'.
    static bool is_same(const Surface& a, const Surface& b) {
        const QVec n = a.gradient({});
        const quad tiny(1e-30);
        return length(n - b.gradient({})) <= tiny * length(n) &&
               absolute(a.value({}) - b.value({})) <= tiny * absolute(a.value({}));
    }

    /// False: not certain.
    bool begin(const Ray& ray, Path& path) const {
        const ImplicitSolid& s = *solid_;
        const Triple<Twofold> o = triple<Twofold>(ray.origin), d = triple<Twofold>(ray.direction);
        const Triple<Twofold> to_center = center_ - o;
        const Twofold square = dot(d, d);
        if (!(square.high > 1e-200 && square.high < 1e200)) return false;
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
            if (miss > 0.999999999 * most) return false;
        }
        path.fine_origin = at.x * matrix_[0] + at.y * matrix_[1] + at.z * matrix_[2] + origin_;
        const Triple<Twofold> step = Twofold(path.unit) * d;
        path.fine_direction = step.x * matrix_[0] + step.y * matrix_[1] + step.z * matrix_[2];
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

    /// The stretch between all planes; whose ends are unlike any other plane's for certain. False: not certain.
    bool between_planes(const Path& path, Ends& ends) const {
        ends.in.at = Rough(-path.reach);
        ends.out.at = Rough(path.reach);
        std::array<std::pair<Bound, const Plane*>, 40> met;
        std::size_t count = 0;
        const Plane *in = nullptr, *out = nullptr;
        for (const Plane& plane : planes_) {
            const Rough at_zero = dot(plane.normal, path.origin) - plane.distance;
            const Rough rate = dot(plane.normal, path.direction);
            const double doubt = margin * plane.rate * path.delta;
            // Wholly on one side, as far as the solid reaches?
            if (solid_->bounded && at_zero.least() > 1.000001 * (rate.most() * path.reach + doubt)) {
                if (at_zero.v > 0) {
                    ends.misses = true;
                    return true;
                }
                continue;
            }
            if (!(rate.least() > 1e8 * rate.off) || count == met.size()) return false;
            // An unbounded one that is nearly parallel may be met anywhere.
            if (!solid_->bounded && !(rate.least() > 1e3 * doubt)) return false;
            Bound bound;
            bound.at = -at_zero / rate;
            bound.width = doubt / std::abs(rate.v) * (solid_->bounded ? 1 : 1 + std::abs(bound.at.v));
            bound.surface = static_cast<int>(plane.k);
            bound.slope = rate.v;
            met[count++] = {bound, &plane};
            if (rate.v < 0 && bound.at.v > ends.in.at.v) ends.in = bound, in = &plane;
            if (rate.v > 0 && bound.at.v < ends.out.at.v) ends.out = bound, out = &plane;
        }
        if (ends.in.is_beyond(ends.out)) {
            ends.misses = true;
            return true;
        }
        if (!ends.out.is_beyond(ends.in)) return false;
        for (std::size_t i = 0; i < count; ++i) {
            const auto& [bound, plane] = met[i];
            const Bound& end = bound.slope < 0 ? ends.in : ends.out;
            const Plane* decides = bound.slope < 0 ? in : out;
            if (decides == nullptr) {  // the ball's end comes first
                if (bound.may_be(end)) return false;
                continue;
            }
            if (plane == decides) continue;
            if (plane->same == decides->same) {
                // The first of the two stands for both.
                if (plane->k < decides->k) (bound.slope < 0 ? ends.in : ends.out).surface = static_cast<int>(plane->k);
                continue;
            }
            // Whichever way both are shifted, the same one decides.
            const double ahead = std::abs(end.at.v - bound.at.v);
            if (!(ahead > 1.000001 * (std::abs(end.width - bound.width) + end.at.off + bound.at.off))) return false;
        }
        return true;
    }

    /// What is left of the intervals within one more surface. False: not certain.
    bool cut(const Path& path, const Curve& curve, Intervals& found) const {
        const Surface& surface = *solid_->surfaces[curve.k];
        const PolynomialOf<Rough> f = surface.rough_along(path.origin, path.direction);
        const double doubt = 2 * margin * (1.75 * curve.steepest * path.delta + curve.noise);
        const RoughRoots roots(f, -path.reach, path.reach, doubt);
        if (!roots.certain()) return false;
        std::array<Bound, Polynomial::max_degree> bounds;
        for (std::size_t i = 0; i < roots.count(); ++i) {
            Bound& b = bounds[i];
            b.at = roots[i].at;
            b.slope = roots[i].slope;
            b.surface = static_cast<int>(curve.k);
            const Triple<Rough> g = surface.rough_gradient(path.origin + b.at * path.direction);
            b.gradient = {dot(columns_[0], g), dot(columns_[1], g), dot(columns_[2], g)};
            const Triple<Rough>& w = b.gradient;
            const double most = std::max({std::abs(w.x.v), std::abs(w.y.v), std::abs(w.z.v)});
            const double off = std::max({w.x.off, w.y.off, w.z.off});
            // Where the gradient all but vanishes, more than it counts.
            if (!(most > 1e-6 * curve.steepest) || !(off < 1e-9 * most)) return false;
            const double e = margin * (1.75 * most * path.delta + curve.noise);
            if (e >= std::abs(b.slope) * path.reach * 0.9e-3) return false;
            b.width = e / std::abs(b.slope);
            if (i > 0 && !b.is_beyond(bounds[i - 1])) return false;
        }
        Intervals left;
        bool inside = roots.begins_inside();
        Bound from{};
        from.at = Rough(-2 * path.reach);
        for (std::size_t i = 0; i <= roots.count(); ++i) {
            Bound to{};
            to.at = Rough(2 * path.reach);
            if (i < roots.count()) to = bounds[i];
            for (const auto& [in, out] : found) {
                if (!inside) continue;
                // What compares ends must be certain of each.
                if (from.may_be(out) || to.may_be(in)) return false;
                if (from.is_beyond(out) || in.is_beyond(to)) continue;
                if (from.may_be(in) || to.may_be(out)) return false;
                left.push_back({from.is_beyond(in) ? from : in, out.is_beyond(to) ? to : out});
            }
            from = to;
            inside = !inside;
        }
        found = std::move(left);
        return true;
    }

    const Plane* plane_of(int surface) const {
        for (const Plane& plane : planes_)
            if (static_cast<int>(plane.k) == surface) return &plane;
        return nullptr;
    }
    /// One Newton step with a residual of 106 bits: from some 50 right bits to 100.
    Twofold refine(const Path& path, const Bound& bound) const {
        if (const Plane* plane = plane_of(bound.surface))
            return (plane->fine_distance - dot(plane->fine_normal, path.fine_origin)) /
                   dot(plane->fine_normal, path.fine_direction);
        const Surface& surface = *solid_->surfaces[static_cast<std::size_t>(bound.surface)];
        const Twofold rest = surface.fine_along(path.fine_origin, path.fine_direction)(Twofold(bound.at.v));
        return Twofold(bound.at.v) - rest / Twofold(bound.slope);
    }
    /// False: not certain.
    bool finish(const Ray& ray, const Path& path, const Bound& in, const Bound& out, Answer& answer) const {
        const ImplicitSolid& s = *solid_;
        const double moved = precision * s.condition * s.size + margin * answer.delta;
        Interval interval;
        Span inner{{-infinity(), -1}, {infinity(), -1}}, outer = inner;
        for (const bool is_in : {true, false}) {
            const Bound& bound = is_in ? in : out;
            End& end = is_in ? interval.in : interval.out;
            if (bound.surface < 0) {
                if (s.bounded) return false;
                end.t = is_in ? -HUGE_VAL : HUGE_VAL;
                continue;
            }
            const auto k = static_cast<std::size_t>(bound.surface);
            const Twofold t = path.closest + refine(path, bound) * Twofold(path.unit);
            end.t = t.high;
            double steep = 0;
            if (const Plane* plane = plane_of(bound.surface)) {
                steep = plane->steep;
                end.normal = plane->outward;
            } else {
                const Triple<Rough>& g = bound.gradient;
                steep = length_of(g);
                const double off = std::max({g.x.off, g.y.off, g.z.off});
                if (off <= 2e-15 * steep) {
                    end.normal = {g.x.v / steep, g.y.v / steep, g.z.v / steep};
                } else {
                    end.normal = to_vec3(s.normal(k, QVec(ray.origin) + t.exactly() * QVec(ray.direction)));
                }
                double doubt = 0;
                for (const Curve& curve : curves_)
                    if (curve.k == k) doubt = curve.blur;
                end.blur = doubt < steep * s.size ? doubt / steep : s.size;
            }
            const double span = path.unit * path.speed;
            end.cosine = std::abs(bound.slope) / (steep * span);
            const double other = bound.width * span * moved / (margin * answer.delta);
            double along_ray = std::max((moved + end.blur) / end.cosine, other);
            if (s.bounded) along_ray = std::min(along_ray, s.size);
            end.tolerance = along_ray / path.speed + 4 * double_epsilon * std::abs(end.t);
            if (!std::isfinite(end.t) || !(end.cosine > 0)) return false;
            const quad exact = t.exactly(), width = bound.width * path.unit;
            oracle::Bound& inner_end = is_in ? inner.in : inner.out;
            oracle::Bound& outer_end = is_in ? outer.in : outer.out;
            inner_end = {is_in ? exact + width : exact - width, bound.surface};
            outer_end = {is_in ? exact - width : exact + width, bound.surface};
        }
        answer.intervals.push_back(interval);
        answer.inner.push_back(inner);
        answer.outer.push_back(outer);
        return true;
    }

    std::shared_ptr<const ImplicitSolid> solid_;
    std::array<Triple<Twofold>, 3> matrix_;  ///< columns of to_local
    std::array<Triple<Rough>, 3> columns_;
    Triple<Twofold> origin_, center_;
    double largest_ = 0, farthest_ = 0;  ///< the largest sum of a row, of the translation
    std::vector<Plane> planes_;
    std::vector<Curve> curves_;
    bool usable_ = true;
};

}  // namespace csgrt::oracle
