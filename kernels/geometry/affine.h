// Affine: solids that are affine images of a canonical shape. Their parameters begin with center[3] and the rows of L
// (9 reals), local = L (p - center).
//
// The ray's origin is first moved to its closest approach to the center (in the solid's own metric), because
// coefficients formed from a far origin lose their digits. The moved origin w = (o - center) + shift * d keeps the
// rounding errors of its two large terms. So w is accurate to a few ulps of |w|, however far away the ray starts.
#ifndef CSGRT_GEOMETRY_AFFINE_H
#define CSGRT_GEOMETRY_AFFINE_H

#include "segments.h"

// A ray in a solid's local space. The local parameter u is the world's t minus `shift`, so numbers near the solid stay
// small.
typedef struct {
    vec3 o, d;   // local; o is the closest approach: o . d is about 0
    real shift;  // t = shift + u, u along (o, d)
} local_ray;

FN vec3 affine_linear(GLOBAL const parameter* p, vec3 v) {
    return make_vec3(dot3(make_vec3(p[3], p[4], p[5]), v), dot3(make_vec3(p[6], p[7], p[8]), v),
                     dot3(make_vec3(p[9], p[10], p[11]), v));
}
// A normal in the world's directions, by the transpose of L.
FN vec3 affine_normal(GLOBAL const parameter* p, vec3 n) {
    return make_vec3(dot3(make_vec3(p[3], p[6], p[9]), n), dot3(make_vec3(p[4], p[7], p[10]), n),
                     dot3(make_vec3(p[5], p[8], p[11]), n));
}

#ifdef CSGRT_EYE_RELATIVE
FN wide3 affine_center(GLOBAL const parameter* p, ray3 r) {
    (void)p;  // unused: here the center is rounded
    return r.center;
}
#else
FN wide3 affine_center(GLOBAL const parameter* p, ray3 r) {
    (void)r;
    return make_vec3(p[0], p[1], p[2]);
}
#endif

INLINE_FN local_ray to_local(GLOBAL const parameter* p, ray3 r) {
    local_ray l;
    offset3 from = offset_from(affine_center(p, r), r.o);
    vec3 o = affine_linear(p, leading(from));
    l.d = affine_linear(p, r.d);
    l.shift = -dot3(o, l.d) / dot3(l.d, l.d);
    l.o = affine_linear(p, moved(from, l.shift, r.d));
    return l;
}

// The local ray with its own origin. A comparison with to_local() shows what the shift gains.
FN local_ray to_local_unmoved(GLOBAL const parameter* p, ray3 r) {
    local_ray l;
    l.o = affine_linear(p, leading(offset_from(affine_center(p, r), r.o)));
    l.d = affine_linear(p, r.d);
    l.shift = 0;
    return l;
}

// The local ray for a method of quartics (quartic.h).
FN local_ray quartic_ray(u32 method, GLOBAL const parameter* p, ray3 r) {
    return method == QUARTIC_UNSHIFTED ? to_local_unmoved(p, r) : to_local(p, r);
}

// The parameter of the closest approach along the unit direction d: 0 if the origin was moved there.
FN real quartic_middle(u32 method, vec3 o, vec3 d) { return method == QUARTIC_UNSHIFTED ? -dot3(o, d) : REAL(0); }

// The depth, relative to the solid's size, below which a ray may only touch the solid and is tested more exactly.
#define TOUCHED REAL(0x1p-12)

FN vec3 local_point(local_ray l, real t) { return add_scaled(l.o, t - l.shift, l.d); }

#endif
