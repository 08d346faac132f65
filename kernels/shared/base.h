// The language that both compilers accept: OpenCL C 1.2 on a device, C++ on the host.
//
// Everything under kernels/ is written in the subset of the two: plain structs of scalars, arguments by value,
// fixed-width integers. Nothing here may round differently on two devices, so: no contraction (the pragma here,
// -ffp-contract=off on the host), fma only where written, and only + - * / sqrt fma floor and
// scaling by powers of 2, which IEEE 754 fixes to the bit.
// Transcendental functions are not bit-equal between devices and stay out.
// Never put two calls with side effects into one argument list: compilers evaluate them in different orders.
#ifndef CSGRT_BASE_H
#define CSGRT_BASE_H

#ifdef __OPENCL_VERSION__
#pragma OPENCL FP_CONTRACT OFF
#ifdef cl_khr_fp64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
typedef CSGRT_REAL real;  // -DCSGRT_REAL=double or float
typedef uint u32;
#define GLOBAL __global
#define FN static
#define REAL_INFINITY ((real)INFINITY)
FN real real_sqrt(real x) { return sqrt(x); }
FN real real_fma(real a, real b, real c) { return fma(a, b, c); }
FN real real_abs(real x) { return fabs(x); }
FN real real_floor(real x) { return floor(x); }
FN int real_exponent(real x) { return ilogb(x); }  // 2^e <= x < 2^(e+1); x > 0
FN real real_scaled(real x, int e) { return ldexp(x, e); }  // x 2^e
#else
// The host includes kernels/ inside a namespace that has defined `real`, `u32` and REAL_INFINITY (src/kernel_host.hpp).
#define GLOBAL
#define FN [[maybe_unused]] static inline
FN real real_sqrt(real x) { return __builtin_sqrt(x); }
FN real real_fma(real a, real b, real c) { return __builtin_fma(a, b, c); }
FN real real_abs(real x) { return x < 0 ? -x : x; }
FN real real_floor(real x) { return __builtin_floor(x); }
FN int real_exponent(real x) { return __builtin_ilogb(x); }
FN real real_scaled(real x, int e) { return __builtin_ldexp(x, e); }
// As OpenCL's: of a NaN and a number, the number.
FN float fmin(float a, float b) { return a < b || b != b ? a : b; }
FN float fmax(float a, float b) { return a > b || b != b ? a : b; }
#endif

#define REAL(x) ((real)(x))

FN real real_min(real a, real b) { return a < b ? a : b; }
FN real real_max(real a, real b) { return a > b ? a : b; }

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
FN vec3 normalize3(vec3 a) { return scale(a, REAL(1) / real_sqrt(dot3(a, a))); }

// A sum or product and what its rounding lost: hi + lo is exact (Knuth 1969; Dekker 1971, with fma).
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

typedef struct {
    vec3 o, d;  // origin and direction; d need not be a unit vector, distances are in units of it
} ray3;

#endif
