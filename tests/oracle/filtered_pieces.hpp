// A solid as filtered_solid.hpp needs it: its surfaces in the filter's numbers, and what each ray needs of them.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "intersect.hpp"

namespace csgrt::oracle {

struct FilteredPlane {
    const Surface* surface = nullptr;
    Triple<BoundedDouble> normal;
    BoundedDouble distance;
    Triple<DoubleDouble> fine_normal;
    DoubleDouble fine_distance;
    double rate = 0;   ///< by how much its function changes, at most, when a point moves by 1 mm
    double steep = 0;  ///< its gradient's length in the world
    Vec3 outward;
    const Surface* same = nullptr;  ///< the first of the planes that are this one
};

struct FilteredCurve {
    const Surface* surface = nullptr;
    double noise = 0;     ///< that counts where its function changes sign: not quadrics'
    double blur = 0;      ///< that counts where that is
    double terms = 1;     ///< of its function, where they are largest
    double steepest = 0;  ///< more than its gradient's components in the world anywhere near the solid
    double longest = 0;   ///< ... and than its length in the solid's own frame
};

/// An intersection of what is within each surface. A solid is one, or a convex union of some.
struct FilteredPiece {
    std::vector<FilteredPlane> planes;
    std::vector<FilteredCurve> curves;
};

namespace detail {

/// Up to the rounding of 113 bits. Arbs have their box's planes, which most often are their faces'.
inline bool same_plane(const Surface& a, const Surface& b) {
    const QVec n = a.gradient({});
    const quad tiny(1e-30);
    return length(n - b.gradient({})) <= tiny * length(n) &&
           absolute(a.value({}) - b.value({})) <= tiny * absolute(a.value({}));
}

inline FilteredPlane filtered_plane(const ImplicitSolid& solid, const Surface& surface,
                                    const std::vector<FilteredPlane>& others) {
    FilteredPlane plane;
    const QAffine& back = solid.to_local;
    const QVec n = surface.gradient({}), world = back.transposed(n);
    const quad distance = -surface.value({});
    plane.surface = plane.same = &surface;
    plane.normal = triple<BoundedDouble>(n);
    plane.distance = BoundedDouble(distance);
    plane.fine_normal = triple<DoubleDouble>(n);
    plane.fine_distance = DoubleDouble(distance);
    quad most = 0;
    for (const QVec& axis : {back.x, back.y, back.z}) most = larger(most, absolute(dot(n, axis)));
    plane.rate = 1.75 * to_double(most);
    plane.steep = to_double(length(world));
    if (plane.steep > 0) plane.outward = to_vec3(unit(world));
    for (const FilteredPlane& other : others)
        if (plane.same == &surface && same_plane(surface, *other.surface)) plane.same = other.same;
    return plane;
}

inline FilteredCurve filtered_curve(const ImplicitSolid& solid, const Surface& surface, double noise, bool is_noisy) {
    FilteredCurve curve;
    curve.surface = &surface;
    curve.blur = noise;
    curve.terms = to_double(surface.terms());
    curve.noise = is_noisy ? noise : 0;
    // It is asked about points within 1.5 radii. The gradient's components are cubic at most, so what 27 points do not
    // show is less than three times what they do.
    for (const double x : {-1, 0, 1})
        for (const double y : {-1, 0, 1})
            for (const double z : {-1, 0, 1}) {
                const QVec p = solid.center + quad(1.5 * solid.radius) * QVec(x, y, z);
                const QVec local = surface.gradient(solid.to_local.point(p)), g = solid.to_local.transposed(local);
                for (const quad component : {g.x, g.y, g.z})
                    curve.steepest = std::max(curve.steepest, 3 * to_double(absolute(component)));
                curve.longest = std::max(curve.longest, 3 * to_double(length(local)));
            }
    return curve;
}

/// The ray in a parameter s: t = closest + s unit, as in intersect.hpp.
struct FilteredRay {
    DoubleDouble closest;
    Vec3 way;  ///< the ray's direction
    double unit = 1, speed = 1, delta = 0, reach = 0;
    Triple<DoubleDouble> fine_origin, fine_direction;
    Triple<BoundedDouble> origin, direction;
    bool misses = false;
};
struct FilteredBound {
    BoundedDouble at;
    double width = 0;                      ///< rounding may shift it by this
    const FilteredPlane* plane = nullptr;  ///< no plane, no curve: it is infinite, or beyond the solid
    const FilteredCurve* curve = nullptr;
    double slope = 0;                ///< of the function along s
    Triple<BoundedDouble> gradient;  ///< of a curve's function, in the world
    double blur = 0;                 ///< of a curve's function

    static FilteredBound none(double at) {
        FilteredBound bound;
        bound.at = BoundedDouble(at);
        return bound;
    }
    /// Farther along than `other` by more than both may be off and shifted, for certain?
    bool is_beyond(const FilteredBound& other) const {
        return at.v - other.at.v > 1.000001 * (at.error + other.at.error + width + other.width);
    }
    bool may_be(const FilteredBound& other) const { return !is_beyond(other) && !other.is_beyond(*this); }
};
/// A few, ascending.
struct FilteredIntervals {
    struct Interval {
        FilteredBound in, out;
    };
    std::array<Interval, 6> all;
    std::size_t count = 0;

    bool add(const FilteredBound& in, const FilteredBound& out) {
        if (count == all.size()) return false;
        all[count++] = {in, out};
        return true;
    }
    void clear() { count = 0; }
    bool empty() const { return count == 0; }
    const Interval* begin() const { return all.data(); }
    const Interval* end() const { return all.data() + count; }
};

}  // namespace detail

/// Empty if the filter cannot treat such a solid. `hull` keeps the surfaces of a solid that is a union.
inline std::vector<FilteredPiece> filtered_pieces(const ImplicitSolid& solid, const std::vector<SurfaceSet>& hull) {
    std::vector<FilteredPiece> pieces;
    bool usable = true;
    const auto add = [&](const Surface& surface, double noise, bool is_hull) {
        if (!surface.is_polynomial()) {
            usable = false;
            return;
        }
        const int degree = surface.along({}, {1, 1, 1}).degree;
        FilteredPiece& piece = pieces.back();
        if (degree == 1) {
            piece.planes.push_back(detail::filtered_plane(solid, surface, piece.planes));
            usable = usable && piece.planes.back().steep > 0;
            return;
        }
        piece.curves.push_back(detail::filtered_curve(solid, surface, noise, is_hull || degree > 2));
        const double steepest = piece.curves.back().steepest;
        usable = usable && std::isfinite(steepest) && steepest > 0;
    };
    for (const SurfaceSet& piece : hull) {
        pieces.emplace_back();
        for (const auto& surface : piece) add(*surface, to_double(solid.noise(0)), true);
    }
    if (hull.empty()) {
        pieces.emplace_back();
        for (std::size_t k = 0; k < solid.surfaces.size(); ++k)
            add(*solid.surfaces[k], to_double(solid.noise(k)), false);
        if (!solid.bounded) usable = usable && pieces[0].planes.size() == 1 && pieces[0].curves.empty();
    }
    if (!usable || !(solid.size > 0) || (solid.bounded && !(solid.radius > 0))) pieces.clear();
    return pieces;
}

}  // namespace csgrt::oracle
