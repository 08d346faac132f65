// What kernels/shared/base.h asks of the host's arithmetic, for each kind of number. Rounded as a device rounds.
#pragma once

namespace csgrt::host {

inline double root(double x) { return __builtin_sqrt(x); }
inline double fma(double a, double b, double c) { return __builtin_fma(a, b, c); }
inline double floor(double x) { return __builtin_floor(x); }
inline int exponent(double x) { return __builtin_ilogb(x); }
inline double scaled(double x, int e) { return __builtin_ldexp(x, e); }

inline float root(float x) { return __builtin_sqrtf(x); }
inline float fma(float a, float b, float c) { return __builtin_fmaf(a, b, c); }
inline float floor(float x) { return __builtin_floorf(x); }
inline int exponent(float x) { return __builtin_ilogbf(x); }
inline float scaled(float x, int e) { return __builtin_ldexpf(x, e); }

}  // namespace csgrt::host
