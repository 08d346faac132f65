// Elliptical hyperboloid (one sheet's cap). Parameters: affine (12), c. Plane 0: base. Surfaces: 0 side, 1 base.
//
//   local z = -1 at the base, +1 at the apex; w = (1 - z) / 2 is the depth below the apex in units of the height:
//   x^2 + y^2 - k w (w + 2 c) < 0,  k = 1 / (1 + 2 c),  w > -c, where the vertex of the asymptotic cone lies
//
// All formulas are in w and k c, which is 1/2 at most. Where c is large, the solid is nearly a paraboloid. There the
// distance below the vertex, c + w, would lose w's digits.
#ifndef CSGRT_GEOMETRY_EHY_H
#define CSGRT_GEOMETRY_EHY_H

#include "affine.h"
#include "plane.h"
#include "polynomial.h"

#define EHY_SIDE 0
#define EHY_BASE 1

FN segments ehy_intersect(Geometry g, SolidRecord solid, ray3 r) {
    GLOBAL const parameter* p = g.reals + solid.first_real;
    span s = clip_to_face(whole_line(), g, solid.first_plane, r, EHY_BASE);
    local_ray l = to_local(p, r);
    const parameter c = p[12];
    const real k = REAL(1) / (REAL(1) + REAL(2) * c), kc = c * k;
    const real w = REAL(0.5) * (REAL(1) - l.o.z), rate = REAL(-0.5) * l.d.z;
    const real vertex = l.shift - (c + w) / rate;
    real a, b, at_zero, wx, wy, cross, discriminant;
    // The other sheet lies at w < -2 c; the ray may be cut anywhere between the two sheets.
    s.low = rate > 0 ? real_max(s.low, vertex) : s.low;
    s.high = rate < 0 ? real_min(s.high, vertex) : s.high;
    s.high = rate == 0 && c + w < 0 ? -REAL_INFINITY : s.high;
    a = real_fma(l.d.x, l.d.x, l.d.y * l.d.y) - k * rate * rate;
    b = real_fma(l.o.x, l.d.x, l.o.y * l.d.y) - rate * real_fma(k, w, kc);
    at_zero = real_fma(l.o.x, l.o.x, l.o.y * l.o.y) - w * real_fma(k, w, REAL(2) * kc);
    // The discriminant b^2 - a at_zero, in which the terms with (k c)^2 |d|^2 cancel.
    wx = difference_of_products(w, l.d.x, rate, l.o.x);
    wy = difference_of_products(w, l.d.y, rate, l.o.y);
    cross = difference_of_products(l.o.x, l.d.y, l.o.y, l.d.x);
    discriminant = k * real_fma(wx, wx, wy * wy) + REAL(2) * kc * real_fma(wx, l.d.x, wy * l.d.y) +
                   difference_of_products(kc * rate, kc * rate, cross, cross);
    return touching(s.touched, quadratic_inside(a, b, at_zero, discriminant, l.shift, s, EHY_SIDE));
}

FN vec3 ehy_normal(Geometry g, SolidRecord solid, ray3 r, real t, u32 surface) {
    GLOBAL const parameter* p = g.reals + solid.first_real;
    const parameter c = p[12];
    vec3 at;
    if (surface != EHY_SIDE) return face_normal(g, solid.first_plane);
    at = local_point(to_local(p, r), t);
    return affine_normal(
        p, make_vec3(at.x, at.y, REAL(0.5) * (c + REAL(0.5) * (REAL(1) - at.z)) / (REAL(1) + REAL(2) * c)));
}

#endif
