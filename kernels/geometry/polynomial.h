// Polynomials: their roots, and the intervals of a ray on which they are negative (inside).
#ifndef CSGRT_GEOMETRY_POLYNOMIAL_H
#define CSGRT_GEOMETRY_POLYNOMIAL_H

#include "quadratic.h"

// The intervals within `s` (in t = shift + u) where q(u) = a u^2 + 2 b u + c is negative: up to two. `discriminant` is
// b^2 - a c, which the caller knows in a form without cancellation. The formula of the roots never subtracts near-equal
// numbers.
//
//   a > 0:  between the roots          a < 0:  outside them, or everywhere
FN segments quadratic_inside(real a, real b, real c, real discriminant, real shift, span s, u32 surface) {
    segments h = no_segments();
    real low, high;
    if (!(s.low < s.high)) return h;
    if (a == 0) {
        if (b == 0) return c < 0 ? append_span(h, s) : h;
        low = shift - c / (REAL(2) * b);
        if (b > 0) {
            if (low < s.high) {
                s.high = low;
                s.high_surface = surface;
            }
        } else if (low > s.low) {
            s.low = low;
            s.low_surface = surface;
        }
        return append_span(h, s);
    }
    if (a > 0) return between_roots(a, b, c, discriminant, shift, s, surface);
    if (!(discriminant > 0)) return a < 0 ? append_span(h, s) : h;
    {
        real root = real_sqrt(discriminant);
        real q = b > 0 ? -(b + root) : root - b;
        real u1 = q / a;
        real u2 = c / q;
        low = shift + real_min(u1, u2);
        high = shift + real_max(u1, u2);
    }
    if (low > s.low)
        h = append(h, s.low, s.low_surface, real_min(low, s.high), low < s.high ? surface : s.high_surface);
    if (high < s.high)
        h = append(h, real_max(high, s.low), high > s.low ? surface : s.low_surface, s.high, s.high_surface);
    return h;
}

// A quartic c0 + c1 u + ... + c4 u^4 and its first derivative.
typedef struct {
    real c[5];
} quartic;

FN real quartic_at(quartic p, real u) {
    return real_fma(real_fma(real_fma(real_fma(p.c[4], u, p.c[3]), u, p.c[2]), u, p.c[1]), u, p.c[0]);
}

FN quartic derivative(quartic p) {
    quartic d;
    d.c[0] = p.c[1];
    d.c[1] = REAL(2) * p.c[2];
    d.c[2] = REAL(3) * p.c[3];
    d.c[3] = REAL(4) * p.c[4];
    d.c[4] = 0;
    return d;
}

// The one root of p between a and b, where p has different signs. Halley's steps start from u, or from the middle, and
// bisection keeps them within the bracket. With p = f0 + f1 v + f2 v^2 + f3 v^3 + ... around u, the root lies at about
// v = -f0 / f1 - v^2 f2 / f1, which is Halley's step. The error of the step is about v^3 ((f2 / f1)^2 - f3 / f1). If
// this is no more than rounding, the root is found. 100 steps halve any bracket of doubles to neighbours; Halley's
// method takes about 3.
#define ROOT_STEPS (sizeof(real) == 16 ? 240 : 100)
#define ROOT_PRECISION BY_PRECISION(0x1p-25, 0x1p-54, 0x1p-114)
FN real bracketed_root(quartic p, real a, real b, int negative_at_a, real u) {
    int step;
    if (!(u > a && u < b)) u = REAL(0.5) * (a + b);
    for (step = 0; step < ROOT_STEPS; ++step) {
        const real p3 = real_fma(p.c[4], u, p.c[3]), p2 = real_fma(p3, u, p.c[2]), p1 = real_fma(p2, u, p.c[1]);
        const real q3 = real_fma(p.c[4], u, p3), q2 = real_fma(q3, u, p2), r3 = real_fma(p.c[4], u, q3);
        const real f0 = real_fma(p1, u, p.c[0]), f1 = real_fma(q2, u, p1), f2 = real_fma(r3, u, q2);
        const real f3 = real_fma(p.c[4], u, r3);
        const real v = f0 * f1 / real_fma(f1, f1, -f0 * f2), size = real_abs(v);
        real next = u - v;
        if ((f0 < 0) == (negative_at_a != 0)) {
            a = u;
        } else {
            b = u;
        }
        if (next == u) return u;
        if (next > a && next < b) {
            const real left = real_fma(f2, f2, real_abs(f1 * f3));
            if (size * size * size * left < ROOT_PRECISION * real_abs(u) * (f1 * f1)) return next;
        } else {
            next = REAL(0.5) * (a + b);
            if (next <= a || next >= b) return u;
        }
        u = next;
    }
    return u;
}

// The number of roots of p between low and high, if the coefficients decide it: 0, 1, or 2 with `split` between them.
// Else 3. The coefficients in Bernstein form change their sign as often as p does, or two or four times more often
// (Descartes' rule; Lane and Riesenfeld 1981). Coefficients whose sign may be an effect of rounding decide nothing.
// `near`: where the straight lines between the coefficients cross 0, which is near the roots.
FN int certain_roots(quartic p, real low, real high, real* split, real* near) {
    const real w = high - low, reach = real_max(real_abs(low), real_abs(high));
    const real doubt =
        BY_PRECISION(0x1p-12, 0x1p-40, 0x1p-98) *
        real_fma(real_fma(real_fma(real_fma(real_abs(p.c[4]), reach, real_abs(p.c[3])), reach, real_abs(p.c[2])), reach,
                          real_abs(p.c[1])),
                 reach, real_abs(p.c[0]));
    // p's value and derivatives at `low`, each divided by the factorial of its order and by its binomial coefficient,
    // in units of the width.
    const real d1 =
        real_fma(real_fma(real_fma(REAL(4) * p.c[4], low, REAL(3) * p.c[3]), low, REAL(2) * p.c[2]), low, p.c[1]) * w *
        REAL(0.25);
    const real d2 = real_fma(real_fma(REAL(6) * p.c[4], low, REAL(3) * p.c[3]), low, p.c[2]) * (w * w) * REAL(1.0 / 6);
    const real d3 = real_fma(REAL(4) * p.c[4], low, p.c[3]) * (w * w * w) * REAL(0.25);
    real b[5];
    real at_split;
    int i, changes = 0, farthest = 0;
    b[0] = quartic_at(p, low);
    b[1] = b[0] + d1;
    b[2] = b[0] + REAL(2) * d1 + d2;
    b[3] = b[0] + REAL(3) * (d1 + d2) + d3;
    b[4] = quartic_at(p, high);
    for (i = 0; i < 5; ++i)
        if (!(real_abs(b[i]) > doubt)) return 3;
    for (i = 0; i < 4; ++i) {
        if ((b[i] < 0) != (b[i + 1] < 0)) {
            if (changes < 2) near[changes] = real_fma(w, REAL(0.25) * ((real)i + b[i] / (b[i] - b[i + 1])), low);
            ++changes;
        }
        if (b[0] < 0 ? b[i] > b[farthest] : b[i] < b[farthest]) farthest = i;
    }
    if (changes < 2) return changes;
    if (changes > 2) return 3;
    *split = real_fma(w, REAL(0.25) * (real)farthest, low);
    at_split = quartic_at(p, *split);
    return real_abs(at_split) > doubt && (at_split < 0) != (b[0] < 0) ? 2 : 3;
}

// The turning points of p in (low, high): ascending, at most 3. The turning points of the derivative are the roots of a
// quadratic, so between two neighbours among them lies one root of the derivative at most.
NOINLINE_FN int turning_points(quartic p, real low, real high, real* turns) {
    const quartic d1 = derivative(p);
    const real a = REAL(3) * d1.c[3], b = d1.c[2], c = d1.c[1];  // the second derivative: a u^2 + 2 b u + c
    const real discriminant = difference_of_products(b, b, a, c);
    real inner[4];
    int inner_count = 0, count = 0, i;
    inner[inner_count++] = low;
    if (discriminant > 0) {
        const real root = real_sqrt(discriminant);
        const real q = b > 0 ? -(b + root) : root - b;
        const real u1 = q / a;
        const real u2 = c / q;
        const real first = real_min(u1, u2), second = real_max(u1, u2);
        if (first > low && first < high) inner[inner_count++] = first;
        if (second > low && second < high) inner[inner_count++] = second;
    }
    inner[inner_count] = high;
    for (i = 0; i < inner_count; ++i) {
        const int negative = quartic_at(d1, inner[i]) < 0;
        const int after = quartic_at(d1, inner[i + 1]) < 0;
        if (negative != after) turns[count++] = bracketed_root(d1, inner[i], inner[i + 1], negative, low);
    }
    return count;
}

// The points where p changes its sign in (low, high): ascending, at most 4. Only negative counts as inside.
// certain_roots() decides most cases. Else the turning points bracket the roots: p is monotone in every bracket, and
// the signs at its limits tell whether it holds a root. So counts and signs always agree.
FN int sign_changes(quartic p, real low, real high, real* roots) {
    real knots[5], near[2];
    int count = 0, i, negative = quartic_at(p, low) < 0;
    const int certain = certain_roots(p, low, high, knots + 1, near);
    const int pieces = certain < 3 ? certain : 1 + turning_points(p, low, high, knots + 1);
    knots[0] = low;
    knots[pieces] = high;
    for (i = 0; i < pieces; ++i) {
        const int after = quartic_at(p, knots[i + 1]) < 0;
        if (negative != after)
            roots[count++] = bracketed_root(p, knots[i], knots[i + 1], negative, certain < 3 ? near[i] : low);
        negative = after;
    }
    return count;
}

// The intervals of `s` inside the solid, from the sign changes in `s`. `inside`: the ray is inside at s.low.
FN segments spans_between(span s, int inside, const real* roots, int count, u32 surface) {
    segments h = no_segments();
    real low = s.low;
    u32 low_surface = s.low_surface;
    int i;
    for (i = 0; i < count; ++i) {
        if (inside) h = append(h, low, low_surface, roots[i], surface);
        low = roots[i];
        low_surface = surface;
        inside = !inside;
    }
    if (inside) h = append(h, low, low_surface, s.high, s.high_surface);
    return h;
}

#endif
