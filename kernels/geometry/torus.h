// Torus: the interval where a ray may meet a torus, and the torus's normal. Parameters, planes and surfaces are the
// tor's (tor.h).
#ifndef CSGRT_GEOMETRY_TORUS_H
#define CSGRT_GEOMETRY_TORUS_H

#include "affine.h"
#include "plane.h"

#define TOR_MARGIN                 \
    BY_PRECISION(1.0001, 1.000001, \
                 1.000001)  // the interval is a little larger than the torus, so that both its limits are outside

// The interval of a ray inside the slab |z| <= ratio and the sphere |p| <= 1 + ratio, between `low` and `high` along
// the unit direction d. Empty: low >= high.
typedef struct {
    local_ray l;
    vec3 d;
    real length;  // of l.d
    real low, high;
} tor_piece;

FN real axis_distance2(vec3 o, vec3 d, real u) {
    real x = real_fma(u, d.x, o.x), y = real_fma(u, d.y, o.y);
    return real_fma(x, x, y * y);
}

FN tor_piece tor_piece_of(u32 method, GLOBAL const parameter* p, ray3 r) {
    const parameter ratio = p[12];
    const real outer = (REAL(1) + ratio) * TOR_MARGIN, tube = ratio * TOR_MARGIN;
    const real inner = (REAL(1) - ratio) * (REAL(2) - TOR_MARGIN);
    real middle, reach, z0, z1, first, last;
    lane_mask crosses, outside;
    tor_piece s;
    s.l = quartic_ray(method, p, r);
    s.length = real_sqrt(dot3(s.l.d, s.l.d));
    s.d = scale(s.l.d, REAL(1) / s.length);
    middle = quartic_middle(method, s.l.o, s.d);
    reach = real_sqrt(outer * outer - (dot3(s.l.o, s.l.o) - middle * middle)) * TOR_MARGIN;  // NaN if the ray misses
    z0 = (-tube - s.l.o.z) / s.d.z;
    z1 = (tube - s.l.o.z) / s.d.z;
    crosses = s.d.z != 0;
    first = real_min(z0, z1);
    last = real_max(z0, z1);
    s.low = middle - reach;
    s.high = middle + reach;
    // The comparisons keep a NaN: a ray that misses the sphere misses the torus, whether or not it meets the slab.
    s.low = crosses && first > s.low ? first : s.low;
    s.high = crosses && last < s.high ? last : s.high;
    outside = !(s.low < s.high) || (!crosses && real_abs(s.l.o.z) > ratio);
    // Most rays through the box of a thin ring pass within the ring. The distance from the axis is greatest at a limit
    // of the interval.
    if (ratio < 1)
        outside =
            outside || real_max(axis_distance2(s.l.o, s.d, s.low), axis_distance2(s.l.o, s.d, s.high)) < inner * inner;
    s.high = outside ? s.low : s.high;
    return s;
}

// The interval of the ray on the inner side of the planes that cut a bend.
FN span tor_bend(Geometry g, SolidRecord solid, ray3 r) {
    span s = whole_line();
    u32 i;
    for (i = 0; i < solid.plane_count; ++i) s = clip_to_face(s, g, solid.first_plane + i, r, 1 + i);
    return s;
}

FN vec3 tor_normal(Geometry g, SolidRecord solid, ray3 r, real t, u32 surface) {
    GLOBAL const parameter* p = g.reals + solid.first_real;
    vec3 at;
    real rho, radial;
    if (surface != 0) return face_normal(g, solid.first_plane + surface - 1);
    at = local_point(to_local(p, r), t);
    rho = real_sqrt(real_fma(at.x, at.x, at.y * at.y));
    radial = (rho - REAL(1)) / rho;
    return affine_normal(p, make_vec3(at.x * radial, at.y * radial, at.z));
}

#endif
