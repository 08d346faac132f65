// Vectors: points, and sums and products with their rounding errors. The file is compiled for one ray and for packets
// (packet/begin.h).
#ifndef CSGRT_SHARED_VECTORS_H
#define CSGRT_SHARED_VECTORS_H

#include "base.h"

typedef struct {
    real x, y, z;
} vec3;

FN vec3 make_vec3(real x, real y, real z) {
    vec3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}
FN vec3 add(vec3 a, vec3 b) { return make_vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
FN vec3 subtract(vec3 a, vec3 b) { return make_vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
FN vec3 scale(vec3 a, real s) { return make_vec3(a.x * s, a.y * s, a.z * s); }
FN vec3 add_scaled(vec3 a, real s, vec3 b) {
    return make_vec3(real_fma(s, b.x, a.x), real_fma(s, b.y, a.y), real_fma(s, b.z, a.z));
}
FN real dot3(vec3 a, vec3 b) { return real_fma(a.z, b.z, real_fma(a.y, b.y, a.x * b.x)); }
FN real sum_of_sizes(vec3 v) { return real_abs(v.x) + real_abs(v.y) + real_abs(v.z); }
FN vec3 normalize3(vec3 a) { return scale(a, REAL(1) / real_sqrt(dot3(a, a))); }
// The unit vector of n; if n has no direction, the unit vector against d.
FN vec3 unit_or_against(vec3 n, vec3 d) {
    const real length2 = dot3(n, n);
    const lane_mask has_direction = length2 > 0 && length2 < REAL_INFINITY;
    n.x = has_direction ? n.x : d.x * REAL(-1);
    n.y = has_direction ? n.y : d.y * REAL(-1);
    n.z = has_direction ? n.z : d.z * REAL(-1);
    return normalize3(n);
}

// A sum or product and its rounding error: hi + lo is exact (Knuth 1969; Dekker 1971, with fma).
typedef struct {
    real hi, lo;
} pair;

FN pair two_sum(real a, real b) {
    pair r;
    real bb;
    r.hi = a + b;
    bb = r.hi - a;
    r.lo = (a - (r.hi - bb)) + (b - bb);
    return r;
}
FN pair two_product(real a, real b) {
    pair r;
    r.hi = a * b;
    r.lo = real_fma(a, b, -r.hi);
    return r;
}

// Coordinates of the world are `wide`, lengths within a solid `real`. The two types are the same, except in
// eye-relative single precision (CSGRT_EYE_RELATIVE). There the world is in double: a ray's origin is brought near the
// scene in double, the solid's center is subtracted in double, and the difference is rounded to float.
#ifdef CSGRT_EYE_RELATIVE
typedef struct {
    wide x, y, z;
} wide3;

#ifdef __OPENCL_VERSION__
FN wide wide_fma(wide a, wide b, wide c) { return fma(a, b, c); }
FN wide wide_sqrt(wide x) { return sqrt(x); }
#else
FN wide wide_fma(wide a, wide b, wide c) { return host::fma(a, b, c); }
FN wide wide_sqrt(wide x) { return host::root(x); }
#endif
FN wide wide_abs(wide x) { return x < 0 ? -x : x; }
FN wide wide_max(wide a, wide b) { return a > b ? a : b; }
FN wide3 make_wide3(wide x, wide y, wide z) {
    wide3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}
FN wide3 wide_subtract(wide3 a, wide3 b) { return make_wide3(a.x - b.x, a.y - b.y, a.z - b.z); }
FN wide3 wide_scale(wide3 a, wide s) { return make_wide3(a.x * s, a.y * s, a.z * s); }
FN wide3 wide_add_scaled(wide3 a, wide s, wide3 b) {
    return make_wide3(wide_fma(s, b.x, a.x), wide_fma(s, b.y, a.y), wide_fma(s, b.z, a.z));
}
FN wide wide_dot(wide3 a, wide3 b) { return wide_fma(a.z, b.z, wide_fma(a.y, b.y, a.x * b.x)); }
FN wide3 widen(vec3 v) { return make_wide3((wide)v.x, (wide)v.y, (wide)v.z); }
FN vec3 narrow(wide3 v) { return make_vec3(REAL(v.x), REAL(v.y), REAL(v.z)); }
// a - b, with the error of its rounding to `real`.
FN pair difference(wide a, wide b) {
    wide all = a - b;
    pair r;
    r.hi = REAL(all);
    r.lo = REAL(all - (wide)r.hi);
    return r;
}
#else
typedef vec3 wide3;
FN wide3 make_wide3(wide x, wide y, wide z) { return make_vec3(x, y, z); }
FN wide3 wide_subtract(wide3 a, wide3 b) { return subtract(a, b); }
FN wide3 wide_scale(wide3 a, wide s) { return scale(a, s); }
FN wide3 wide_add_scaled(wide3 a, wide s, wide3 b) { return add_scaled(a, s, b); }
FN wide wide_dot(wide3 a, wide3 b) { return dot3(a, b); }
FN wide wide_sqrt(wide x) { return real_sqrt(x); }
FN wide wide_abs(wide x) { return real_abs(x); }
FN wide wide_max(wide a, wide b) { return real_max(a, b); }
FN vec3 widen(vec3 v) { return v; }
FN vec3 narrow(wide3 v) { return v; }
FN pair difference(wide a, wide b) { return two_sum(a, -b); }
#endif

// A point relative to another, with the rounding errors kept.
typedef struct {
    pair x, y, z;
} offset3;

FN offset3 offset_from(wide3 center, wide3 p) {
    offset3 o;
    o.x = difference(p.x, center.x);
    o.y = difference(p.y, center.y);
    o.z = difference(p.z, center.z);
    return o;
}
FN vec3 leading(offset3 o) { return make_vec3(o.x.hi, o.y.hi, o.z.hi); }

FN real moved_by(pair offset, real shift, real d) {
    pair step = two_product(shift, d);
    pair sum = two_sum(offset.hi, step.hi);
    return sum.hi + (sum.lo + (step.lo + offset.lo));
}
// o + shift d, accurate to a few ulps of the result, however large the two terms are.
FN vec3 moved(offset3 o, real shift, vec3 d) {
    return make_vec3(moved_by(o.x, shift, d.x), moved_by(o.y, shift, d.y), moved_by(o.z, shift, d.z));
}

// A ray in the world.
typedef struct {
    wide3 o, d;
} world_ray;

// A ray for the functions of geometry/.
typedef struct {
    wide3 o;  // origin
    vec3 d;   // direction; it need not be a unit vector, distances are in units of it
#ifdef CSGRT_EYE_RELATIVE
    wide start;    // how far the origin was moved along the ray, in millimetres; d is a unit vector
    wide3 center;  // of the solid that the ray is tested against
#endif
} ray3;

#endif
