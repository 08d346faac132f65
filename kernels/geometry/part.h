// Particle: two balls on the local z axis and the cone that touches both. Parameters: affine (12, a similarity), then
// z0, r0, z1, r1 of the balls, the cone's radius m0 + m1 z, and the range of z in which the cone runs: between the
// circles where it touches the balls. If one ball contains the other, there is no cone: low > high.
//
//         .-""-._____
//        /   :       ``.        The solid is convex: the least in and the greatest out of its parts along a ray are its
//       (    : z0   :z1 )       own. The cone's caps lie inside the balls. If rounding lets a ray meet a cap first, the
//        \   :_____ ..'         point lies at the very circle, and counts as the ball's.
//         `-..-'
//
// The solid's normal has no jump, so there is one surface, 0. A particle that ends in a point has its local origin
// there.
#ifndef CSGRT_GEOMETRY_PART_H
#define CSGRT_GEOMETRY_PART_H

#include "tgc.h"

// The one segment around `s` and all segments of `h`.
FN span hull_of(span s, segments h) {
    if (h.count == 0) return s;
    s.low = real_min(s.low, h.in0);
    s.high = real_max(s.high, h.out0);
    return s;
}

FN segments ball_inside(local_ray l, real z, real radius) {
    vec3 o = make_vec3(l.o.x, l.o.y, l.o.z - z);
    real x = difference_of_products(o.y, l.d.z, o.z, l.d.y);
    real y = difference_of_products(o.z, l.d.x, o.x, l.d.z);
    real w = difference_of_products(o.x, l.d.y, o.y, l.d.x);
    real a = dot3(l.d, l.d);
    real miss = real_sqrt(dot3(make_vec3(x, y, w), make_vec3(x, y, w)));
    real reach = radius * real_sqrt(a);
    return quadratic_inside(a, dot3(o, l.d), dot3(o, o) - radius * radius, (reach - miss) * (reach + miss), l.shift,
                            whole_line(), 0);
}

FN segments part_intersect(GLOBAL const real* p, ray3 r) {
    local_ray l = to_local(p, r);
    span all = whole_line();
    all.low = REAL_INFINITY;
    all.high = -REAL_INFINITY;
    all = hull_of(all, ball_inside(l, p[12], p[13]));
    all = hull_of(all, ball_inside(l, p[14], p[15]));
    if (p[18] < p[19]) {
        span s = whole_line();
        if (l.d.z != 0) {
            real first = (p[18] - l.o.z) / l.d.z, second = (p[19] - l.o.z) / l.d.z;
            s.low = l.shift + real_min(first, second);
            s.high = l.shift + real_max(first, second);
        } else if (!(l.o.z > p[18] && l.o.z < p[19])) {
            s.high = s.low;
        }
        if (s.low < s.high) {
            const real m0 = real_fma(p[17], l.o.z, p[16]), m1 = p[17] * l.d.z;
            all = hull_of(all, cone_inside(l, round_side(l, m0, m1), m0, m1, s));
        }
    }
    return append(no_segments(), all.low, 0, all.high, 0);
}

FN vec3 part_normal(GLOBAL const real* p, ray3 r, real t) {
    vec3 at = local_point(to_local(p, r), t);
    if (p[18] < p[19] && at.z > p[18] && at.z < p[19])
        at.z = -real_fma(p[17], at.z, p[16]) * p[17];
    else if (p[18] < p[19])
        at.z = at.z - p[at.z <= p[18] ? 12 : 14];
    else
        at.z = at.z - p[p[13] > p[15] ? 12 : 14];
    return affine_normal(p, at);
}

#endif
