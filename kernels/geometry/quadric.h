// Quadric: a solid that is one quadric cut by planes: epa, hyp, rpc, rhc. Parameters: affine (12), then qx, qy, qz,
// linear, free:
//
//   qx x^2 + qy y^2 + qz z^2 + linear z + free < 0
//
//   epa  elliptic paraboloid         x^2 + y^2 + z - 1            base z > 0
//   hyp  hyperboloid of one sheet    x^2 + y^2 - k z^2 - free     ends |z| < 1
//   rpc  parabolic cylinder          y^2 + z - 1                  base z > 0, ends |x| < 1
//   rhc  hyperbolic cylinder         y^2 - k z^2 + k c^2          base, ends; a plane that cuts the other branch off
//
// Planes: any number; surface 0 is the quadric, surface 1 + i plane i.
#ifndef CSGRT_GEOMETRY_QUADRIC_H
#define CSGRT_GEOMETRY_QUADRIC_H

#include "affine.h"
#include "plane.h"
#include "polynomial.h"

#define QUADRIC_SURFACE 0
#define QUADRIC_PLANES 1

// The sum of the form's terms in v and w without their signs: the size to which rounding is relative.
FN real quadric_size(GLOBAL const parameter* p, vec3 v, vec3 w) {
    return real_abs(p[12] * v.x * w.x) + real_abs(p[13] * v.y * w.y) + real_abs(p[14] * v.z * w.z);
}

FN segments quadric_intersect(Geometry g, SolidRecord solid, ray3 r) {
    GLOBAL const parameter* p = g.reals + solid.first_real;
    const parameter qx = p[12], qy = p[13], qz = p[14], linear = p[15], at_zero = p[16];
    span s = whole_line();
    local_ray l;
    u32 i;
    real a, b, c, xy, yz, zx, discriminant;
    for (i = 0; i < solid.plane_count; ++i) s = clip_to_face(s, g, solid.first_plane + i, r, QUADRIC_PLANES + i);
    if (no_lane(s.low < s.high)) return no_segments();
    l = to_local(p, r);
    a = real_fma(qx * l.d.x, l.d.x, real_fma(qy * l.d.y, l.d.y, qz * l.d.z * l.d.z));
    b = real_fma(qx * l.o.x, l.d.x, real_fma(qy * l.o.y, l.d.y, qz * l.o.z * l.d.z));
    c = real_fma(qx * l.o.x, l.o.x, real_fma(qy * l.o.y, l.o.y, qz * l.o.z * l.o.z));
    // The discriminant b^2 - a c of the squares alone is -(qx qy (o x d)z^2 + ...), by Lagrange's identity: no large
    // terms cancel.
    xy = difference_of_products(l.o.x, l.d.y, l.o.y, l.d.x);
    yz = difference_of_products(l.o.y, l.d.z, l.o.z, l.d.y);
    zx = difference_of_products(l.o.z, l.d.x, l.o.x, l.d.z);
    discriminant = -real_fma(qx * qy * xy, xy, real_fma(qy * qz * yz, yz, qz * qx * zx * zx));
    {
        real half_rate = REAL(0.5) * linear * l.d.z;
        real rest = real_fma(linear, l.o.z, at_zero);
        real all_a = quadric_size(p, l.d, l.d), all_b = quadric_size(p, l.o, l.d) + real_abs(half_rate);
        real all_c = quadric_size(p, l.o, l.o) + real_abs(linear * l.o.z) + real_abs(at_zero);
        real of_squares = real_abs(qx * qy) * xy * xy + real_abs(qy * qz) * yz * yz + real_abs(qz * qx) * zx * zx;
        discriminant = discriminant + (half_rate * (REAL(2) * b + half_rate) - a * rest);
        of_squares =
            of_squares + real_abs(half_rate) * (REAL(2) * real_abs(b) + real_abs(half_rate)) + real_abs(a * rest);
        b = b + half_rate;
        c = c + rest;
        // Along a straight line of the surface a, b and c vanish together. There b^2 - a c is the more accurate
        // discriminant.
        discriminant = real_abs(b) * all_b + real_abs(a) * all_c + real_abs(c) * all_a < REAL(0.0625) * of_squares
                           ? difference_of_products(b, b, a, c)
                           : discriminant;
    }
    return touching(s.touched, quadratic_inside(a, b, c, discriminant, l.shift, s, QUADRIC_SURFACE));
}

FN vec3 quadric_normal(Geometry g, SolidRecord solid, ray3 r, real t, u32 surface) {
    GLOBAL const parameter* p = g.reals + solid.first_real;
    vec3 at;
    if (surface != QUADRIC_SURFACE) return face_normal(g, solid.first_plane + surface - QUADRIC_PLANES);
    at = local_point(to_local(p, r), t);
    return affine_normal(p, make_vec3(p[12] * at.x, p[13] * at.y, real_fma(p[14], at.z, REAL(0.5) * p[15])));
}

#endif
