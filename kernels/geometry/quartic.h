// Quartic: four ways to solve the quartics of tor, eto and tapered cones, for comparison. The first is the default.
//
//   QUARTIC_BRACKETED  sign_changes (polynomial.h), with the origin at the closest approach
//   QUARTIC_UNSHIFTED  the same with the ray's own origin: coefficients lose their digits as it moves away
//   QUARTIC_FERRARI    the closed form, ferrari.h
//   QUARTIC_YUKSEL     roots between those of the derivative, to a stated error (Yuksel 2022, High-Performance
//                      Polynomial Root Finding for Graphics), whose cubic is deflated once a root of it is known
#ifndef CSGRT_GEOMETRY_QUARTIC_H
#define CSGRT_GEOMETRY_QUARTIC_H

#include "affine.h"
#include "ferrari.h"
#include "polynomial.h"

// The error at which Yuksel's search ends, in units of the solid: half the digits, as in Yuksel's own code. The solid
// polishes the roots.
#define YUKSEL_ERROR BY_PRECISION(6e-4, 6e-7, 6e-7)
#define YUKSEL_STEPS 100

// The longest step by which a solid polishes a root, in the solid's units.
#define POLISH_STEP BY_PRECISION(1e-3, 1e-6, 1e-6)

// Newton's method from the middle of [a, b], within the shrinking bracket, until a step is no longer than YUKSEL_ERROR.
FN real yuksel_root(quartic p, quartic slope, real a, real b, int negative_at_a) {
    real u = REAL(0.5) * (a + b);
    int step;
    for (step = 0; step < YUKSEL_STEPS && b - a > REAL(2) * YUKSEL_ERROR; ++step) {
        real value = quartic_at(p, u);
        real next = u - value / quartic_at(slope, u);
        if ((value < 0) == (negative_at_a != 0)) {
            a = u;
        } else {
            b = u;
        }
        if (!(next > a && next < b)) next = REAL(0.5) * (a + b);
        if (real_abs(next - u) <= YUKSEL_ERROR) return next;
        u = next;
    }
    return u;
}

// The roots of a u^2 + 2 b u + c between low and high, ascending.
FN int quadratic_between(real a, real b, real c, real low, real high, real* roots) {
    real discriminant = b * b - a * c, q, u1, u2, first, second;
    int count = 0;
    if (!(discriminant > 0)) return 0;
    q = b > 0 ? -(b + real_sqrt(discriminant)) : real_sqrt(discriminant) - b;
    u1 = q / a;
    u2 = c / q;
    first = real_min(u1, u2);
    second = real_max(u1, u2);
    if (first > low && first < high) roots[count++] = first;
    if (second > low && second < high) roots[count++] = second;
    return count;
}

// Roots of the derivative, a cubic d with derivative e: the first root in its bracket, the others as roots of the
// deflated cubic.
FN int yuksel_turns(quartic d, quartic e, real low, real high, real* turns) {
    real knots[4];
    int count, i, negative = quartic_at(d, low) < 0;
    knots[0] = low;
    count = 1 + quadratic_between(e.c[2], REAL(0.5) * e.c[1], e.c[0], low, high, knots + 1);
    knots[count] = high;
    for (i = 0; i < count; ++i) {
        if ((quartic_at(d, knots[i + 1]) < 0) == negative) continue;
        turns[0] = yuksel_root(d, e, knots[i], knots[i + 1], negative);
        if (i + 1 == count) return 1;
        {
            real b = real_fma(d.c[3], turns[0], d.c[2]), c = real_fma(b, turns[0], d.c[1]);
            return 1 + quadratic_between(d.c[3], REAL(0.5) * b, c, turns[0], high, turns + 1);
        }
    }
    return 0;
}

FN int yuksel_roots(quartic p, real low, real high, real* roots) {
    quartic d = derivative(p), e = derivative(d);
    real knots[5];
    int count = 0, turns = yuksel_turns(d, e, low, high, knots + 1), i, negative = quartic_at(p, low) < 0;
    knots[0] = low;
    knots[turns + 1] = high;
    for (i = 0; i <= turns; ++i) {
        int after = quartic_at(p, knots[i + 1]) < 0;
        if (negative != after) roots[count++] = yuksel_root(p, d, knots[i], knots[i + 1], negative);
        negative = after;
    }
    return count;
}

// The points where p changes its sign in (low, high): ascending, at most 4.
FN int quartic_roots(u32 method, quartic p, real low, real high, real* roots) {
    if (method == QUARTIC_FERRARI) return ferrari_roots(p, low, high, roots);
    if (method == QUARTIC_YUKSEL) return yuksel_roots(p, low, high, roots);
    return sign_changes(p, low, high, roots);
}

#endif
