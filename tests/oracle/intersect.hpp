// The judge's answer for one ray and one solid: where the ray is inside, and how sure that is.
//
// For every function of the solid the ray's restriction is solved in 113 bits, and three sets are kept: `exact`,
// where it is not positive; `inner` and `outer`, where that stays so, or may become so, when the ray or the solid moves
// by up to `margin` x delta. The solid's sets are the intersections. delta is the displacement that rounding the inputs
// can cause:
//
//     delta = ulps x 2^-53 x condition x (placement + |t_c d| + radius)
//
// with t_c the parameter of closest approach to the solid's centre (so |t_c d| + radius + |centre| bounds |o|), and
// placement and condition as in solid.hpp. A root at slope f' can move by change(delta) / |f'|; a minimum or maximum
// within change(delta) of 0 can gain or lose a pair of roots. For quartics change(delta) includes the rounding of f
// itself, ulps x 2^-53 x terms (solid.hpp), which is more than that only where the gradient all but vanishes: where a
// torus touches itself, on the ends of a wedge. The answer is decided if inner, exact and outer have the same number of
// intervals, one in the other; otherwise rounding may decide either way, and the ray is a tie. A half-space is the one
// unbounded solid: a ray that is parallel to its plane, up to the rounding of their own numbers, stays on its side; one
// that is a few roundings off is a tie wherever it runs.
//
// An end of a decided interval may be off by
//
//     tolerance = (1e-12 x condition x size + margin x delta + blur) / (|d| cos) + 4 x 2^-53 x |t|
//
// with cos = |n . d| / |d| between ray and normal: a surface that is displaced by e moves the hit by e / cos. blur is
// the displacement by rounding in f itself, ulps x 2^-53 x terms / |gradient|: far below 1e-12 sizes, except next to an
// apex and on slivers (solid.hpp). It bears on where ends are, not on how many there are. Close to an edge the surface
// behind may decide instead, so the tolerance is no less than what inner and outer span, scaled to that displacement;
// and never more than the solid's size, which counts where the normal is undefined, at an apex.
#pragma once

#include <vector>

#include <csgrt/renderer.hpp>

#include "solid.hpp"
#include "spans.hpp"

namespace csgrt::oracle {

inline constexpr double margin = 4;         ///< between what may move and what is decided
inline constexpr double precision = 1e-12;  ///< of ends of segments, in sizes

struct End {
    double t = 0;          ///< may be infinite
    Vec3 normal;           ///< unit, outward; undefined where the end is infinite
    double cosine = 1;     ///< |normal . d| / |d|
    double blur = 0;       ///< see above; millimetres
    double tolerance = 0;  ///< along the ray, in units of its direction
};
struct Interval {
    End in, out;
};
struct Answer {
    std::vector<Interval> intervals;
    Spans inner, outer;  ///< certainly inside, possibly inside; along the ray, in units of its direction
    bool tie = false;
    double delta = 0;  ///< millimetres
};

/// What the ray does to the solid, exactly. The ray's doubles are taken as they are. Functions that are no polynomials
/// are sampled, so two roots that are close together may be missed; `look_at` has distances where they are sampled more
/// closely.
Answer intersect(const ImplicitSolid& solid, const Ray& ray, const std::vector<double>& look_at = {});

}  // namespace csgrt::oracle
