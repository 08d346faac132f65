// The language that both compilers accept: OpenCL C 1.2 on a device, C++ on the host.
//
// Everything under kernels/ is written in the subset of the two: plain structs of scalars, arguments by value,
// fixed-width integers. Nothing here may round differently on two devices. So there is no contraction (the pragma here,
// -ffp-contract=off on the host), and the compiler makes no fma of its own. The only operations are + - * / sqrt fma
// floor and scaling by powers of 2, which IEEE 754 fixes to the bit. Transcendental functions are not bit-equal between
// devices and stay out. Never put two calls with side effects into one argument list: compilers evaluate them in
// different orders.
#ifndef CSGRT_SHARED_BASE_H
#define CSGRT_SHARED_BASE_H

#ifdef __OPENCL_VERSION__
#ifdef CSGRT_CONTRACT  // to measure the effect of contraction: results then differ between devices
#pragma OPENCL FP_CONTRACT ON
#else
#pragma OPENCL FP_CONTRACT OFF
#endif
#ifdef cl_khr_fp64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
#ifdef CSGRT_BUILTINS
#include "builtins.h"
#endif
typedef CSGRT_REAL real;  // -DCSGRT_REAL=double or float
#ifdef CSGRT_EYE_RELATIVE
typedef double wide;
#else
typedef real wide;
#endif
typedef uint u32;
#define GLOBAL __global
// The memory that holds a ray's boundaries: global, or, in programs for first hits, private.
#ifdef CSGRT_PRIVATE_BOUNDARIES
#define BOUNDARY_SPACE __private
#else
#define BOUNDARY_SPACE __global
#endif
#ifdef CSGRT_PACKETS  // packet/packet.h: the same functions for one ray and for several
#define FN static __attribute__((overloadable))
#else
#define FN static
#endif
// A function that is always inlined: its call would take longer than its work.
#ifdef CSGRT_NO_INLINE  // for a simulator that lacks some instructions that inlining produces
#define INLINE_FN FN
#else
#define INLINE_FN FN inline __attribute__((always_inline))
#endif
// A function for rare work within hot code. A processor calls the function. On a GPU it is inlined, because a call
// takes registers from all code around it (measured: docs/experiments.md).
#if defined(CSGRT_PACKETS) || defined(CSGRT_NO_INLINE)
#define RARE_FN NOINLINE_FN
#else
#define RARE_FN FN
#endif
// A function for large and rare work. Inlined, it would take a GPU's registers from all other code.
#define NOINLINE_FN FN __attribute__((noinline))
// A function into which all functions that it calls are inlined, where this pays. A device's compiler does this in any
// case.
#define WHOLE_FN FN
#define REAL_INFINITY ((real)INFINITY)
FN real real_sqrt(real x) { return sqrt(x); }
FN real real_fma(real a, real b, real c) { return fma(a, b, c); }
FN real real_abs(real x) { return fabs(x); }
FN real real_floor(real x) { return floor(x); }
FN int real_exponent(real x) { return ilogb(x); }           // 2^e <= x < 2^(e+1); x > 0
FN real real_scaled(real x, int e) { return ldexp(x, e); }  // x 2^e
#else
// The host includes kernels/ inside a namespace that has defined `real`, `wide`, `u32` and REAL_INFINITY
// (src/kernel_host/kernels.hpp); src/kernel_host/math.hpp has the functions for each kind of number.
#define GLOBAL
#define BOUNDARY_SPACE
#define FN [[maybe_unused]] static inline
#define INLINE_FN FN
#define NOINLINE_FN FN
#define RARE_FN FN
#define WHOLE_FN FN
FN real real_sqrt(real x) { return host::root(x); }
FN real real_fma(real a, real b, real c) { return host::fma(a, b, c); }
FN real real_abs(real x) { return host::abs(x); }
FN real real_floor(real x) { return host::floor(x); }
FN int real_exponent(real x) { return host::exponent(x); }
FN real real_scaled(real x, int e) { return host::scaled(x, e); }
FN u32 clz(u32 x) { return (u32)__builtin_clz(x); }  // x > 0
#endif

// Types that packets redefine as vectors, to compile the same source once more (packet/begin.h). Here they hold one
// ray's values.
typedef float single;
typedef int lane_mask;         // the result of a comparison of two reals: 1 or 0; -1 or 0 in each lane of a vector
typedef int single_lane_mask;  // the result of a comparison of two singles
typedef u32 tag;               // a count or a surface
// A number of a solid. It is the same for all rays, also in a packet.
typedef real parameter;
FN int no_lane(lane_mask x) { return !x; }
FN single to_single(real x) { return (float)x; }

#define REAL(x) ((real)(x))
#define SINGLE(x) ((single)(x))
#define TAG(x) ((tag)(x))
// A limit that depends on how many bits a number has: 24, 53 or 113. `parameter` has as many bits as `real`, which may
// be a vector.
#define BY_PRECISION(single, twofold, quadruple) \
    (sizeof(parameter) == 4 ? REAL(single) : sizeof(parameter) == 8 ? REAL(twofold) : REAL(quadruple))

// The relative error of a product of two numbers of a point, a direction or a surface: a few roundings of each. The
// error is the same in 113 bits as in double, since the numbers come in double.
#define ROUNDING BY_PRECISION(0x1p-21, 0x1p-50, 0x1p-50)

// The number of the lowest bit that is set; bits > 0.
FN u32 lowest(u32 bits) { return 31u - clz(bits & (0u - bits)); }

// The smaller of two floats. A GPU has one instruction for fmin. On a processor fmin takes several instructions,
// because it ignores NaNs, so processors compare.
#if defined(__OPENCL_VERSION__) && !defined(CSGRT_PACKETS)
FN float single_min(float a, float b) { return fmin(a, b); }
FN float single_max(float a, float b) { return fmax(a, b); }
#else
FN float single_min(float a, float b) { return a < b ? a : b; }
FN float single_max(float a, float b) { return a > b ? a : b; }
#endif
FN real real_min(real a, real b) { return a < b ? a : b; }
FN real real_max(real a, real b) { return a > b ? a : b; }

#endif
