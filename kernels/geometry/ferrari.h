// Ferrari: the roots of a quartic in closed form (Ferrari 1545). The largest root of the resolvent cubic splits the
// quartic into two quadratics. The method is fast, but wrong where two of its steps subtract near-equal numbers. It is
// here for comparison.
//
//   u = y - c3 / 4:   y^4 + p y^2 + q y + r  =  (y^2 + s y + e) (y^2 - s y + f),   s^2 = 2 m
//   m^3 + p m^2 + (p^2 / 4 - r) m - q^2 / 8 = 0
#ifndef CSGRT_GEOMETRY_FERRARI_H
#define CSGRT_GEOMETRY_FERRARI_H

#include "polynomial.h"
#include "power.h"

// cos(acos(x) / 3), which is the c in [1/2, 1] with 4 c^3 - 3 c = x. (2 c - 1)^2 (c + 1) = x + 1 gives a first value
// that is accurate at the double root, too. Newton's method improves it.
FN real cosine_of_third(real x) {
    real above = real_max(REAL(0), x + REAL(1));
    real c = REAL(0.5) + REAL(0.5) * real_sqrt(above / REAL(1.75));
    int step;
    for (step = 0; step < 5; ++step) {
        real twice = REAL(2) * c - REAL(1);
        real slope = twice * (REAL(6) * c + REAL(3));
        if (!(slope > 0)) return c;
        c = c - (twice * twice * (c + REAL(1)) - above) / slope;
    }
    return c;
}

// The largest real root of m^3 + a m^2 + b m + c (Cardano 1545, Viete 1591).
FN real largest_cubic_root(real a, real b, real c) {
    real third = a / REAL(3);
    real p = b / REAL(3) - third * third;                              // v = m + third:
    real q = REAL(0.5) * (third * (REAL(2) * third * third - b) + c);  // v^3 + 3 p v + 2 q
    real discriminant = q * q + p * p * p;
    if (discriminant < 0) {
        real size = real_sqrt(-p);
        return REAL(2) * size * cosine_of_third(real_max(REAL(-1), real_min(REAL(1), -q / (size * size * size)))) -
               third;
    }
    {
        real w = cube_root(real_abs(q) + real_sqrt(discriminant));
        real v = w > 0 ? w - p / w : REAL(0);
        return (q > 0 ? -v : v) - third;
    }
}

FN int insert_root(real* roots, int count, real u, real low, real high) {
    int i = count;
    if (!(u > low && u < high)) return count;
    for (; i > 0 && roots[i - 1] > u; --i) roots[i] = roots[i - 1];
    roots[i] = u;
    return count + 1;
}

// Inserts the roots of y^2 + 2 b y + c, moved by `shift`. A double root is left out, because the polynomial does not
// change its sign there.
FN int insert_pair(real* roots, int count, real b, real c, real shift, real low, real high) {
    real discriminant = b * b - c, q;
    if (!(discriminant > 0)) return count;
    q = b > 0 ? -(b + real_sqrt(discriminant)) : real_sqrt(discriminant) - b;
    count = insert_root(roots, count, q + shift, low, high);
    return insert_root(roots, count, c / q + shift, low, high);
}

FN int ferrari_roots(quartic g, real low, real high, real* roots) {
    real lead = g.c[4], a = g.c[3] / lead, b = g.c[2] / lead, c = g.c[1] / lead, d = g.c[0] / lead;
    real quarter = REAL(0.25) * a;
    real square = quarter * quarter;
    real p = b - REAL(6) * square;
    real q = c - REAL(2) * quarter * b + REAL(8) * quarter * square;
    real r = d - quarter * c + square * b - REAL(3) * square * square;
    real m = largest_cubic_root(p, REAL(0.25) * p * p - r, REAL(-0.125) * q * q);
    int count = 0;
    if (m > 0) {
        real s = real_sqrt(REAL(2) * m), even = REAL(0.5) * p + m, odd = q / (REAL(2) * s);
        count = insert_pair(roots, count, REAL(0.5) * s, even - odd, -quarter, low, high);
        count = insert_pair(roots, count, REAL(-0.5) * s, even + odd, -quarter, low, high);
    } else {  // q is 0: a quadratic in y^2
        real of_squares = REAL(0.25) * p * p - r, i;
        if (!(of_squares >= 0)) return 0;
        i = real_sqrt(of_squares);
        count = insert_pair(roots, count, REAL(0), REAL(0.5) * p + i, -quarter, low, high);
        count = insert_pair(roots, count, REAL(0), REAL(0.5) * p - i, -quarter, low, high);
    }
    return count;
}

#endif
