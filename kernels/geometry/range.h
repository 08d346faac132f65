// Ranges: the interval arithmetic that some solids need. A range holds the values that a quantity may have on an
// interval of a ray.
#ifndef CSGRT_GEOMETRY_RANGE_H
#define CSGRT_GEOMETRY_RANGE_H

#include "../shared/base.h"

// All values from `low` to `high`.
typedef struct {
    real low, high;
} range;

// The range of a quantity that is monotone between two points, from its values there.
FN range range_between(real a, real b) {
    range r;
    r.low = real_min(a, b);
    r.high = real_max(a, b);
    return r;
}
FN range range_sum(range a, range b) {
    a.low = a.low + b.low;
    a.high = a.high + b.high;
    return a;
}
FN real product_or_0(real a, real b) { return a == 0 || b == 0 ? REAL(0) : a * b; }  // 0 times infinity is 0
FN range range_scaled(range a, real s) { return range_between(product_or_0(a.low, s), product_or_0(a.high, s)); }
FN range range_product(range a, range b) {
    real p = product_or_0(a.low, b.low), q = product_or_0(a.low, b.high);
    real s = product_or_0(a.high, b.low), t = product_or_0(a.high, b.high);
    range r;
    r.low = real_min(real_min(p, q), real_min(s, t));
    r.high = real_max(real_max(p, q), real_max(s, t));
    return r;
}
FN range range_square(range a) {
    range r = range_between(a.low * a.low, a.high * a.high);
    if (a.low < 0 && a.high > 0) r.low = 0;
    return r;
}
FN u32 range_has_0(range a) { return !(a.low > 0) && !(a.high < 0); }

#endif
