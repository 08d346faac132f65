// Cone: parts of the test of a ray against a cylinder or cone: the two end caps, the side of a round cone, and the
// interval where the ray may meet a side that is not round. Parameters, planes and surfaces are the tgc's (tgc.h).
#ifndef CSGRT_GEOMETRY_CONE_H
#define CSGRT_GEOMETRY_CONE_H

#include "affine.h"
#include "plane.h"
#include "quadratic.h"

#define TGC_SIDE 0
#define TGC_BASE 1
#define TGC_TOP 2

FN span between_ends(Geometry g, SolidRecord solid, ray3 r) {
    return clip_to_face(clip_to_face(whole_line(), g, solid.first_plane, r, TGC_BASE), g, solid.first_plane + 1, r,
                        TGC_TOP);
}

// A quadratic a u^2 + 2 b u + c, and its discriminant b^2 - a c. `most`: the greatest discriminant, of a ray through
// the axis.
typedef struct {
    real a, b, c, discriminant, most;
} quadratic;

// The quadratic x^2 + y^2 - m^2 with m = m0 + m1 u, the radius along the ray. Its discriminant b^2 - a c equals |m0 d -
// m1 o|^2 - (o x d)^2 (all in x, y), which keeps its digits where b^2 and a c cancel.
//
// A cone with an apex has its local origin there (m0 = m1 z / d.z exactly), so that rays past the apex keep their
// digits.
FN quadratic round_side(local_ray l, real m0, real m1) {
    const real wx = difference_of_products(m0, l.d.x, m1, l.o.x), wy = difference_of_products(m0, l.d.y, m1, l.o.y);
    const real cross = difference_of_products(l.o.x, l.d.y, l.o.y, l.d.x);
    const real w = real_sqrt(real_fma(wx, wx, wy * wy));
    quadratic f;
    f.a = real_fma(l.d.x, l.d.x, l.d.y * l.d.y) - m1 * m1;
    f.b = real_fma(l.o.x, l.d.x, l.o.y * l.d.y) - m0 * m1;
    f.c = real_fma(l.o.x, l.o.x, l.o.y * l.o.y) - m0 * m0;
    f.discriminant = (w - real_abs(cross)) * (w + real_abs(cross));
    f.most = w * w;
    return f;
}

// May the ray only touch the side, because it grazes the side or runs along it?
FN lane_mask may_touch_side(local_ray l, quadratic f, real m0) {
    const lane_mask along = real_abs(f.a) <= TOUCHED * TOUCHED * dot3(l.d, l.d) && real_abs(f.c) <= TOUCHED * (m0 * m0);
    return real_abs(f.discriminant) < f.most * TOUCHED || along;
}

// The part of `s` in which the ray may meet a side that is not round: everything lies within radius2. u is in units of
// the direction's length. Empty: low >= high.
FN span tapered_piece(u32 method, GLOBAL const parameter* p, local_ray l, span s) {
    const real length = real_sqrt(dot3(l.d, l.d));
    const real middle = quartic_middle(method, l.o, scale(l.d, REAL(1) / length));
    const real reach = REAL(1.0001) * real_sqrt(p[17] - (dot3(l.o, l.o) - middle * middle));
    s.low = (s.low - l.shift) * length;
    s.high = (s.high - l.shift) * length;
    // If the ray misses, `reach` is NaN, and so are both limits.
    s.low = s.low > middle - reach ? s.low : middle - reach;
    s.high = s.high < middle + reach ? s.high : middle + reach;
    return s;
}

FN vec3 round_normal(GLOBAL const parameter* p, ray3 r, real t) {
    const vec3 at = local_point(to_local(p, r), t);
    return affine_normal(p, make_vec3(at.x, at.y, -real_fma(p[13], at.z, p[12]) * p[13]));
}

FN vec3 tapered_normal(GLOBAL const parameter* p, ray3 r, real t) {
    const vec3 at = local_point(to_local(p, r), t);
    const real a = real_fma(p[13], at.z, p[12]), b = real_fma(p[15], at.z, p[14]);
    return affine_normal(
        p, make_vec3(at.x * b * b, at.y * a * a,
                     at.x * at.x * b * p[15] + at.y * at.y * a * p[13] - a * b * real_fma(p[13], b, a * p[15])));
}

FN vec3 tgc_normal(Geometry g, SolidRecord solid, ray3 r, real t, u32 surface) {
    GLOBAL const parameter* p = g.reals + solid.first_real;
    if (surface != TGC_SIDE) return face_normal(g, solid.first_plane + surface - TGC_BASE);
    return p[16] == 0 ? round_normal(p, r, t) : tapered_normal(p, r, t);
}

#endif
