// What a ray meets of a cylinder or cone, whatever the shape of its side: the two ends; and the side of a round one.
// Parameters, planes and surfaces are the tgc's (tgc.h).
#ifndef CSGRT_CONE_H
#define CSGRT_CONE_H

#include "affine.h"
#include "plane.h"
#include "quadratic.h"

#define TGC_SIDE 0
#define TGC_BASE 1
#define TGC_TOP 2

FN span between_ends(Geometry g, SolidRecord solid, ray3 r) {
    return clip_to_face(clip_to_face(whole_line(), g, solid.first_plane, r, TGC_BASE), g, solid.first_plane + 1, r, TGC_TOP);
}

// a u^2 + 2 b u + c, and b^2 - a c.
typedef struct {
    real a, b, c, discriminant;
} quadratic;

// x^2 + y^2 - m^2 with m = m0 + m1 u, the radius along the ray. Its discriminant b^2 - a c equals
// |m0 d - m1 o|^2 - (o x d)^2 (all in x, y), which does not cancel where b^2 and a c do.
//
// A cone with a true apex has it as its local origin (m0 = m1 z / d.z exactly), so that rays past the apex keep their digits.
FN quadratic round_side(local_ray l, real m0, real m1) {
    const real wx = difference_of_products(m0, l.d.x, m1, l.o.x), wy = difference_of_products(m0, l.d.y, m1, l.o.y);
    const real cross = difference_of_products(l.o.x, l.d.y, l.o.y, l.d.x);
    const real w = real_sqrt(real_fma(wx, wx, wy * wy));
    quadratic f;
    f.a = real_fma(l.d.x, l.d.x, l.d.y * l.d.y) - m1 * m1;
    f.b = real_fma(l.o.x, l.d.x, l.o.y * l.d.y) - m0 * m1;
    f.c = real_fma(l.o.x, l.o.x, l.o.y * l.o.y) - m0 * m0;
    f.discriminant = (w - real_abs(cross)) * (w + real_abs(cross));
    return f;
}

FN vec3 round_normal(GLOBAL const parameter* p, ray3 r, real t) {
    const vec3 at = local_point(to_local(p, r), t);
    return affine_normal(p, make_vec3(at.x, at.y, -real_fma(p[13], at.z, p[12]) * p[13]));
}

#endif
