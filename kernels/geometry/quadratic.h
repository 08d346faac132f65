// Quadratic: the interval where a quadratic is negative, between its two roots.
#ifndef CSGRT_GEOMETRY_QUADRATIC_H
#define CSGRT_GEOMETRY_QUADRATIC_H

#include "segments.h"

// a b - c d with an error of at most 1.5 ulps (Kahan; Jeannerod, Louvet, Muller 2013).
FN real difference_of_products(real a, real b, real c, real d) {
    real cd = c * d;
    real lost = real_fma(-c, d, cd);
    return real_fma(a, b, -cd) + lost;
}

// The part of `s` that lies between the roots, as quadratic_inside (polynomial.h) for a > 0. The formula of the roots
// never subtracts near-equal numbers.
FN segments between_roots(real a, real b, real c, real discriminant, real shift, span s, u32 surface) {
    const lane_mask real_roots = discriminant > 0, inside_at_0 = c < 0;
    real root, q, u1, u2, low, high;
    if (no_lane(real_roots || inside_at_0)) return no_segments();
    // A ray that is inside at u = 0 has roots, however far away. Along an asymptote only rounding is left of `a` and of
    // the discriminant.
    discriminant = real_roots ? discriminant : real_fma(b, b, -a * c);
    root = real_sqrt(discriminant);
    q = b > 0 ? -(b + root) : root - b;
    u1 = q / a;
    u2 = c / q;
    low = shift + real_min(u1, u2);
    high = shift + real_max(u1, u2);
    s.low_surface = low > s.low ? TAG(surface) : s.low_surface;
    s.low = low > s.low ? low : s.low;
    s.high_surface = high < s.high ? TAG(surface) : s.high_surface;
    s.high = high < s.high ? high : s.high;
    s.high = real_roots || inside_at_0 ? s.high : -REAL_INFINITY;
    return append(no_segments(), s.low, s.low_surface, s.high, s.high_surface);
}

#endif
