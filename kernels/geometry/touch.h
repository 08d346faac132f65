// Touch: a ray touches a solid all along a segment, as far as rounding lets csgrt tell. The ray runs in a face or along
// a wall, or its depth in the solid is no more than rounding. The two boundaries of the segment are marked with the
// sides on which the moved ray would miss the solid (MISSED_...). The code is here and not in each solid, because it is
// seldom needed: inlined rare code takes a GPU's registers and keeps a processor from using vectors.
#ifndef CSGRT_GEOMETRY_TOUCH_H
#define CSGRT_GEOMETRY_TOUCH_H

#include "cone.h"
#include "plane.h"

// The distances by which rounding of the ray's and of the solid's numbers may move each coordinate of a point of the
// local ray, and of a surface of about size 1. Across a thin solid these distances are far greater than along it.
FN vec3 local_roundings(GLOBAL const parameter* p, ray3 r) {
    const vec3 o = narrow(r.o), c = narrow(affine_center(p, r));
    const real x = real_abs(o.x) + real_abs(c.x), y = real_abs(o.y) + real_abs(c.y), z = real_abs(o.z) + real_abs(c.z);
    return make_vec3(
        ROUNDING * (REAL(1) + real_abs(REAL(p[3])) * x + real_abs(REAL(p[4])) * y + real_abs(REAL(p[5])) * z),
        ROUNDING * (REAL(1) + real_abs(REAL(p[6])) * x + real_abs(REAL(p[7])) * y + real_abs(REAL(p[8])) * z),
        ROUNDING * (REAL(1) + real_abs(REAL(p[9])) * x + real_abs(REAL(p[10])) * y + real_abs(REAL(p[11])) * z));
}

FN real local_rounding(GLOBAL const parameter* p, ray3 r) {
    const vec3 e = local_roundings(p, r);
    return real_max(e.x, real_max(e.y, e.z));
}

FN vec3 cross3(vec3 a, vec3 b) {
    return make_vec3(difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
                     difference_of_products(a.x, b.y, a.y, b.x));
}

// The directions in which a ray in a face is moved: above, and left. Left is the same for the reversed ray.
FN vec3 above_faces(void) { return make_vec3(REAL(1), REAL(ABOVE_Y), REAL(ABOVE_Z)); }
FN vec3 left_of_ray(ray3 r) {
    const vec3 d = scale(r.d, REAL(1) / real_sqrt(dot3(r.d, r.d)));
    return cross3(dot3(d, above_faces()) < 0 ? scale(d, REAL(-1)) : d, above_faces());
}

// The sides on which a ray misses a face that it touches. `n`: the face's outward normal. The two faces of a plane have
// opposite sides, even if the plane contains one of the directions.
FN u32 missed_sides(vec3 n, ray3 r) {
    const real above = dot3(n, above_faces()), left = dot3(n, left_of_ray(r));
    if (above >= 0) return MISSED_ABOVE | (left >= 0 ? MISSED_LEFT : MISSED_RIGHT);
    return MISSED_BELOW | (left <= 0 ? MISSED_RIGHT : MISSED_LEFT);
}

// The sides that lie beyond a plane in which the ray runs.
FN u32 missed_of_plane(PlaneRecord plane, u32 flipped, ray3 r) {
    const u32 missed = missed_sides(narrow(plane_normal(plane)), r);
    return flipped ? MISSED & ~missed : missed;
}

// The sides that lie beyond the planes of a solid in which the ray runs.
FN u32 missed_of_planes(Geometry g, u32 first, u32 count, ray3 r) {
    u32 i, missed = 0;
    for (i = first; i < first + count; ++i) {
        const PlaneRef ref = g.words[i];
        const PlaneRecord plane = g.planes[ref >> 1];
        if (runs_in(plane, r)) missed |= missed_of_plane(plane, ref & 1u, r);
    }
    return missed;
}

FN segments mark(segments h, u32 missed) {
    h.in0_surface |= missed;
    h.out0_surface |= missed;
    h.in1_surface |= missed;
    h.out1_surface |= missed;
    return h;
}

FN segments mark_ell(GLOBAL const real* p, ray3 r, segments h) {
    const vec3 q = local_point(to_local(p, r), REAL(0.5) * (h.in0 + h.out0));
    return REAL(1) - real_sqrt(dot3(q, q)) <= local_rounding(p, r) ? mark(h, missed_sides(affine_normal(p, q), r)) : h;
}

// The depth of a point within the side of a round cone; negative: outside.
FN real depth_in_side(GLOBAL const real* p, vec3 at) {
    return real_fma(p[13], at.z, p[12]) - real_sqrt(real_fma(at.x, at.x, at.y * at.y));
}

// Marks a segment along the side of a cone. The ray is within the cone from base to top, whatever rounding does.
FN segments mark_side(GLOBAL const real* p, ray3 r, span ends, segments h) {
    const local_ray l = to_local(p, r);
    const real most = local_rounding(p, r);
    const int along = ends.low < ends.high && real_abs(depth_in_side(p, local_point(l, ends.low))) <= most &&
                      real_abs(depth_in_side(p, local_point(l, ends.high))) <= most;
    vec3 at;
    if (along) h = append(no_segments(), ends.low, ends.low_surface, ends.high, ends.high_surface);
    at = local_point(l, REAL(0.5) * (h.in0 + h.out0));
    if (h.count != 1 || depth_in_side(p, at) > most) return h;
    return mark(h, missed_sides(affine_normal(p, make_vec3(at.x, at.y, -real_fma(p[13], at.z, p[12]) * p[13])), r));
}

// The sides on which a ray misses a torus that it touches between `in` and `out`.
FN u32 missed_of_tor(GLOBAL const real* p, ray3 r, real in, real out) {
    const vec3 at = local_point(to_local(p, r), REAL(0.5) * (in + out));
    const real rho = real_sqrt(real_fma(at.x, at.x, at.y * at.y)), radial = rho - REAL(1);
    if (p[12] - real_sqrt(real_fma(radial, radial, at.z * at.z)) > local_rounding(p, r)) return 0;
    return missed_sides(affine_normal(p, make_vec3(at.x * radial / rho, at.y * radial / rho, at.z)), r);
}

// The segments of a solid that the ray may only touch, marked if the ray does so.
RARE_FN segments mark_touched(Geometry g, SolidRecord solid, ray3 r, segments h) {
    GLOBAL const real* p = g.reals + solid.first_real;
    if (solid.type == SOLID_ELL) h = mark_ell(p, r, h);
    if (solid.type == SOLID_TGC && p[16] == 0) h = mark_side(p, r, between_ends(g, solid, r), h);
    if (solid.type == SOLID_TOR) {
        const u32 first = h.count > 0 ? missed_of_tor(p, r, h.in0, h.out0) : 0;
        const u32 second = h.count > 1 ? missed_of_tor(p, r, h.in1, h.out1) : 0;
        h.in0_surface |= first;
        h.out0_surface |= first;
        h.in1_surface |= second;
        h.out1_surface |= second;
    }
    return mark(h, missed_of_planes(g, solid.first_plane, solid.plane_count, r));
}

#endif
