// Elliptical hyperboloid (one sheet's cap). Parameters: affine (12), c. Plane 0: base. Surfaces: 0 side, 1 base.
//
//   local z = -1 at the base, +1 at the apex; zeta = c + (1 - z) / 2 is the distance below the vertex of the asymptotic
//   cone in units of the height:   x^2 + y^2 - k (zeta^2 - c^2) < 0,  k = 1 / (1 + 2 c),  zeta > 0
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
    const real root_k = real_sqrt(REAL(1) / (REAL(1) + REAL(2) * c));
    const real zeta = c + REAL(0.5) * (REAL(1) - l.o.z), zeta_rate = REAL(-0.5) * l.d.z;
    const real m0 = root_k * zeta, m1 = root_k * zeta_rate, gap = root_k * c;
    const real apex = l.shift - zeta / zeta_rate;
    real a, b, at_zero, wx, wy, cross, discriminant;
    // The other sheet lies at zeta < 0; the cut may be anywhere between the two.
    s.low = zeta_rate > 0 ? real_max(s.low, apex) : s.low;
    s.high = zeta_rate < 0 ? real_min(s.high, apex) : s.high;
    s.high = zeta_rate == 0 && zeta < 0 ? -REAL_INFINITY : s.high;
    a = real_fma(l.d.x, l.d.x, l.d.y * l.d.y) - m1 * m1;
    b = real_fma(l.o.x, l.d.x, l.o.y * l.d.y) - m0 * m1;
    at_zero = real_fma(l.o.x, l.o.x, l.o.y * l.o.y) - (m0 - gap) * (m0 + gap);
    wx = difference_of_products(m0, l.d.x, m1, l.o.x);
    wy = difference_of_products(m0, l.d.y, m1, l.o.y);
    cross = difference_of_products(l.o.x, l.d.y, l.o.y, l.d.x);
    discriminant = real_fma(wx, wx, wy * wy) - real_fma(gap * gap, a, cross * cross);
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
