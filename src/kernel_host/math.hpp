// Math: the host's arithmetic for kernels/shared/base.h, for each type of number. It rounds as a device rounds.
#pragma once

namespace csgrt::host {

/// A number that hides its origin from the compiler. GCC (12 at least) turns -fma(a, b, c) into fma(-a, b, -c) if the
/// processor has this as one instruction. Where a b + c is 0, the zero then has the other sign, and no option prevents
/// this. In float the reference has no fma instruction (double_fma.hpp).
[[gnu::always_inline]] inline double opaque(double x) {
#if defined(__GNUC__) && !defined(__clang__)
#if defined(__x86_64__)
    __asm__("" : "+x"(x));
#elif defined(__aarch64__)
    __asm__("" : "+w"(x));
#else
    __asm__("" : "+g"(x));
#endif
#endif
    return x;
}

inline double root(double x) { return __builtin_sqrt(x); }
inline double fma(double a, double b, double c) { return opaque(__builtin_fma(a, b, c)); }
inline double abs(double x) { return __builtin_fabs(x); }
inline double floor(double x) { return __builtin_floor(x); }
inline int exponent(double x) { return __builtin_ilogb(x); }
inline double scaled(double x, int e) { return __builtin_ldexp(x, e); }

inline float root(float x) { return __builtin_sqrtf(x); }
inline float fma(float a, float b, float c) { return __builtin_fmaf(a, b, c); }
inline float abs(float x) { return __builtin_fabsf(x); }
inline float floor(float x) { return __builtin_floorf(x); }
inline int exponent(float x) { return __builtin_ilogbf(x); }
inline float scaled(float x, int e) { return __builtin_ldexpf(x, e); }

}  // namespace csgrt::host
