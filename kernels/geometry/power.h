// Powers with real exponents, the same to the bit on every device: only + - * / fma floor and exact scaling by powers
// of 2. log2 by atanh's series on sqrt(1/2) .. sqrt(2), exp2 by Taylor's on -1/2 .. 1/2; both within about 1 ulp of
// double. With 113 bits the series are longer.
#ifndef CSGRT_GEOMETRY_POWER_H
#define CSGRT_GEOMETRY_POWER_H

#include "../shared/base.h"

// log2(x), for x > 0 and finite.
FN real log_2(real x) {
    int exponent = real_exponent(x);
    real m = real_scaled(x, -exponent);  // 1 <= m < 2
    real f, g, sum;
    if (m > REAL(1.4142135623730951)) {
        m = REAL(0.5) * m;
        exponent = exponent + 1;
    }
    f = (m - REAL(1)) / (m + REAL(1));  // log m = 2 (f + f^3 / 3 + f^5 / 5 + ...), f^2 < 0.0295
    g = f * f;
    if (sizeof(real) == 16) {
        int k;
        for (sum = 0, k = 27; k > 0; --k) sum = sum * g + REAL(1) / REAL(2 * k + 1);
        sum = f * g * sum + f;
        return (real)exponent +
               (REAL(2.8853900817779268) + REAL(4.0710547481862066e-17) + REAL(-2.1229319912234516e-33)) * sum;
    }
    sum = REAL(1) / REAL(23);
    sum = real_fma(sum, g, REAL(1) / REAL(21));
    sum = real_fma(sum, g, REAL(1) / REAL(19));
    sum = real_fma(sum, g, REAL(1) / REAL(17));
    sum = real_fma(sum, g, REAL(1) / REAL(15));
    sum = real_fma(sum, g, REAL(1) / REAL(13));
    sum = real_fma(sum, g, REAL(1) / REAL(11));
    sum = real_fma(sum, g, REAL(1) / REAL(9));
    sum = real_fma(sum, g, REAL(1) / REAL(7));
    sum = real_fma(sum, g, REAL(1) / REAL(5));
    sum = real_fma(sum, g, REAL(1) / REAL(3));
    // 2 / ln 2 in two parts
    sum = real_fma(f * g, sum, f);
    return (real)exponent + real_fma(REAL(2.8853900817779268), sum, REAL(4.0710547481862066e-17) * sum);
}

#define LEAST_EXPONENT \
    (sizeof(real) == 4 ? -125 : -1021)  // below, exp_2 is 0: not every device rounds subnormals alike

FN real exp_2(real y) {
    real whole, x, sum;
    if (!(y > REAL(LEAST_EXPONENT))) return 0;
    if (y > REAL(-LEAST_EXPONENT)) return REAL_INFINITY;
    whole = real_floor(y + REAL(0.5));
    x = REAL(0.6931471805599453) * (y - whole);  // |x| < 0.347
    if (sizeof(real) == 16) {
        int k;
        x = (REAL(0.6931471805599453) + REAL(2.3190468138462996e-17) + REAL(5.707708438416212e-34)) * (y - whole);
        for (sum = 1, k = 28; k > 0; --k) sum = REAL(1) + x / REAL(k) * sum;
        return real_scaled(sum, (int)whole);
    }
    sum = REAL(1) / REAL(6227020800);
    sum = real_fma(sum, x, REAL(1) / REAL(479001600));
    sum = real_fma(sum, x, REAL(1) / REAL(39916800));
    sum = real_fma(sum, x, REAL(1) / REAL(3628800));
    sum = real_fma(sum, x, REAL(1) / REAL(362880));
    sum = real_fma(sum, x, REAL(1) / REAL(40320));
    sum = real_fma(sum, x, REAL(1) / REAL(5040));
    sum = real_fma(sum, x, REAL(1) / REAL(720));
    sum = real_fma(sum, x, REAL(1) / REAL(120));
    sum = real_fma(sum, x, REAL(1) / REAL(24));
    sum = real_fma(sum, x, REAL(1) / REAL(6));
    sum = real_fma(sum, x, REAL(0.5));
    sum = real_fma(sum * x, x, x);
    return real_scaled(REAL(1) + sum, (int)whole);
}

// x^y, for x >= 0 and y > 0.
FN real real_power(real x, real y) { return x > 0 ? exp_2(y * log_2(x)) : REAL(0); }

// x^(1/3); 0 for x <= 0.
FN real cube_root(real x) {
    real c;
    if (!(x > 0)) return 0;
    c = exp_2(log_2(x) / REAL(3));
    return c - (c * c * c - x) / (REAL(3) * c * c);
}

#endif
