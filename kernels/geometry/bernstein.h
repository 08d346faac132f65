// Bernstein: where a polynomial in Bernstein form changes its sign in [0, 1]. The test of a curve against a ray makes
// such polynomials.
//
// A polynomial has as many sign changes as its coefficients, or fewer by an even number (Descartes' rule in Bernstein
// form; Lane and Riesenfeld 1981). Intervals with more than one sign change are halved, from left to right. Only the
// position in the binary tree is remembered, so the walk needs no stack:
//
//     0 ------------------------------------ 1     coefficients + - - +    two: halve
//     0 ------- 1/2                                            + - -       one: found
//               1/2 ------------------------ 1                 - - +       one: found
//
// Zero counts as negative everywhere. The values at 0 and 1 are the first and last coefficients to the bit, and a value
// in between is computed once. So the number of changes is even exactly if the values at 0 and 1 have one sign,
// whatever rounding does inside. Two changes closer than 2^-SIGN_DEPTH may both be missed: the value between them is
// within rounding of zero. The exception is a turned outline that ends on the axis: there the value shrinks with the
// radius and keeps its digits. So next to 0 and 1 intervals are halved down to 2^-TIP_DEPTH.
#ifndef CSGRT_GEOMETRY_BERNSTEIN_H
#define CSGRT_GEOMETRY_BERNSTEIN_H

#include "../shared/base.h"

#define BERNSTEIN_SIZE 25  // coefficients at most: degree 24
#define SIGN_DEPTH (sizeof(real) == 4 ? 22u : 28u)
#define TIP_DEPTH (sizeof(real) == 4 ? 22u : 52u)
#define TIP_PIECES REAL(0x1p20)  // an interval counts as next to 0 or 1 within so many of its sizes

// (1 - t) a + t b, exact at 0 and 1.
FN real blend(real t, real a, real b) { return real_fma(t, b, (REAL(1) - t) * a); }

// The coefficients for [low, high] from the coefficients for [0, 1], by de Casteljau's algorithm. The last coefficient
// is the value at `high`, the same for every `low`.
FN void restrict_to(const real* c, u32 degree, real low, real high, real* q) {
    u32 i, round;
    for (i = 0; i <= degree; ++i) q[i] = c[i];
    for (round = 1; round <= degree; ++round)
        for (i = degree; i >= round; --i) q[i] = blend(high, q[i - 1], q[i]);
    if (low > 0) {
        real at = low / high;
        for (round = 1; round <= degree; ++round)
            for (i = 0; i + round <= degree; ++i) q[i] = blend(at, q[i], q[i + 1]);
    }
}

FN u32 coefficient_changes(const real* c, u32 degree) {
    u32 count = 0, i;
    for (i = 0; i < degree; ++i) count += (c[i] > 0) != (c[i + 1] > 0);
    return count;
}

// The state of the walk through a polynomial's sign changes: the position in the binary tree of intervals, and the
// interval of the last change.
typedef struct {
    u32 depth;
    real index, size;  // the next interval: [index, index + 1] size; a whole number, and 2^-depth
    int positive;      // the sign at the interval's low limit
    real low, high;    // the last interval that holds a change
} sign_walk;

FN sign_walk start_sign_walk(const real* c) {
    sign_walk w;
    w.depth = 0;
    w.index = 0;
    w.size = 1;
    w.positive = c[0] > 0;
    w.low = w.high = 0;
    return w;
}

// Moves to the next change, which w->low and w->high then enclose; w->positive is the sign after the change. 0: there
// is no change left.
FN int next_sign_change(const real* c, u32 degree, sign_walk* w) {
    real q[BERNSTEIN_SIZE];
    while (w->index * w->size < 1) {
        real low = w->index * w->size, high = (w->index + REAL(1)) * w->size;
        int beside_end = real_min(low, REAL(1) - low) < TIP_PIECES * w->size;
        u32 changes;
        int before = w->positive;
        restrict_to(c, degree, low, high, q);
        if ((q[0] > 0) != before) q[0] = before ? REAL(1) : REAL(0);  // the sign where the interval before ended
        changes = coefficient_changes(q, degree);
        if (changes > 1 && w->depth < (beside_end ? TIP_DEPTH : SIGN_DEPTH)) {
            ++w->depth;
            w->index = REAL(2) * w->index;
            w->size = REAL(0.5) * w->size;
            continue;
        }
        w->positive = q[degree] > 0;
        w->index = w->index + REAL(1);
        while (w->depth > 0 && real_floor(REAL(0.5) * w->index) == REAL(0.5) * w->index) {
            w->index = REAL(0.5) * w->index;
            w->size = REAL(2) * w->size;
            --w->depth;
        }
        if (w->positive != before) {
            w->low = low;
            w->high = high;
            return 1;
        }
    }
    return 0;
}

// Newton's method in a bracket. A step that leaves the bracket, or does not halve the step before, is replaced by a
// bisection.
typedef struct {
    real low, high, at, step;
    int positive;  // the sign at `low`; at `high` the sign is opposite
    int done;
} bracket;

#define BRACKET_STEPS \
    (sizeof(real) == 16 ? 240 : 120)  // a bisection every other step halves [0, 1] to neighbours; Newton takes about 5
#define PARAMETER_PRECISION BY_PRECISION(0x1p-24, 0x1p-53, 0x1p-113)  // of a curve's parameter, which runs from 0 to 1

FN bracket start_bracket(real low, real high, int positive) {
    bracket b;
    b.low = low;
    b.high = high;
    b.at = REAL(0.5) * (low + high);
    b.step = high - low;
    b.positive = positive;
    b.done = !(low < b.at && b.at < high);
    return b;
}

FN bracket newton_step(bracket b, real value, real slope) {
    real next;
    if ((value > 0) == (b.positive != 0)) {
        b.low = b.at;
    } else {
        b.high = b.at;
    }
    next = b.at - value / slope;
    if (!(next >= b.low && next <= b.high && real_abs(next - b.at) <= REAL(0.5) * b.step))
        next = REAL(0.5) * (b.low + b.high);
    b.step = real_abs(next - b.at);
    b.at = next;
    b.done = b.step <= PARAMETER_PRECISION;
    return b;
}

#endif
