// Superellipsoid. Parameters: affine (12), p, q, r. Surface 0.
//
//   G = (|x|^p + |y|^p)^q + |z|^r - 1 < 0        p = 2 / e, q = e / n, r = 2 / n
//
// Along a ray each of |x|, |y|, |z| is linear between the points where x, y or z is 0. There its powers are monotone.
// So the ranges of these powers, of G and of its slope over an interval follow from the values at the interval's two
// limits. With p q = r, s = |x|^p + |y|^p and Lagrange's identity the second derivative is
//
//   G'' / r = (r-1) (s^(q-2) (x^(p-1) x' + y^(p-1) y')^2 + z^(r-2) z'^2) + (p-1) s^(q-2) (x y)^(p-2) (x y' - x' y)^2
//
// where x y' - x' y is the same all along the ray. If p-1 and r-1 are not of opposite signs (e, n <= 2: the solid is
// convex; e, n >= 2: a star), G'' has one sign, and G has at most one turning point in the whole part. Else intervals
// are walked from the front. Each interval is so small that one of three facts is certain: G has no 0; or its slope has
// no 0, so the signs of G at the two limits tell whether there is a root; or its second derivative has no 0, so G has
// at most one turning point. If no fact is certain down to SUPERELL_LEAST of the part (a ray that touches within
// rounding, or runs within a flat side), or after SUPERELL_STEPS intervals, the signs at the limits decide, too.
#ifndef CSGRT_GEOMETRY_SUPERELL_H
#define CSGRT_GEOMETRY_SUPERELL_H

#include "affine.h"
#include "crossings.h"
#include "power.h"
#include "range.h"

#define SUPERELL_MARGIN            \
    BY_PRECISION(1.0001, 1.000001, \
                 1.000001)  // the searched interval is a little larger than the solid, so both its limits are outside
#define SUPERELL_LEAST BY_PRECISION(0x1p-18, 0x1p-45, 0x1p-90)
#define SUPERELL_STEPS 500
#define SUPERELL_NOISE BY_PRECISION(1e-5, 1e-14, 1e-32)  // a greater |G| is not only rounding
#define SUPERELL_TURN_STEPS (sizeof(real) == 16 ? 120 : 60)
#define SUPERELL_ROOT_STEPS (sizeof(real) == 16 ? 240 : 120)

// One local coordinate along the ray. Its absolute value is |rate| |u - zero| if it is 0 somewhere in the searched
// interval.
typedef struct {
    real at, rate, zero;
    u32 has_zero;
} superell_axis;

FN superell_axis superell_axis_of(real at, real rate, real low, real high) {
    superell_axis a;
    a.at = at;
    a.rate = rate;
    a.zero = -at / rate;
    a.has_zero = a.zero > low && a.zero < high;
    return a;
}
FN real superell_size(superell_axis a, real u) {
    return a.has_zero ? real_abs(a.rate) * real_abs(u - a.zero) : real_abs(real_fma(a.rate, u, a.at));
}
// The rate of change of the coordinate's absolute value at u.
FN real superell_rate(superell_axis a, real u) {
    real value = a.has_zero ? a.rate * (u - a.zero) : real_fma(a.rate, u, a.at);
    return value < 0 ? -a.rate : a.rate;
}

// The three coordinates along a ray, and the solid's exponents.
typedef struct {
    superell_axis x, y, z;
    real p, q, r;
    real twist;  // (x y' - x' y)^2
} superell_ray;

// G and its slope over r at u; x^p, x^(p-1), x^(p-2), and so on for y and z.
typedef struct {
    real u, value, slope;
    real x, y, z;
    real by_x, by_y, by_z;
    real by_xx, by_yy, by_zz;
} superell_point;

// x^(p-1), from x^p.
FN real superell_lower(real x, real power_of_x, real p) {
    if (x > 0) return power_of_x / x;
    return p > 1 ? REAL(0) : p < 1 ? REAL_INFINITY : REAL(1);
}

// The values at u. `rate`: the rates of change of |x|, |y|, |z|.
FN superell_point superell_at(superell_ray l, vec3 rate, real u) {
    superell_point a;
    real x = superell_size(l.x, u), y = superell_size(l.y, u), z = superell_size(l.z, u);
    real s, outer;
    a.u = u;
    a.x = real_power(x, l.p);
    a.y = real_power(y, l.p);
    a.z = real_power(z, l.r);
    a.by_x = superell_lower(x, a.x, l.p);
    a.by_y = superell_lower(y, a.y, l.p);
    a.by_z = superell_lower(z, a.z, l.r);
    a.by_xx = superell_lower(x, a.by_x, l.p - REAL(1));
    a.by_yy = superell_lower(y, a.by_y, l.p - REAL(1));
    a.by_zz = superell_lower(z, a.by_z, l.r - REAL(1));
    s = a.x + a.y;
    outer = real_power(s, l.q);
    a.value = outer + (a.z - REAL(1));
    if (x == 0 && y == 0) {
        // A ray through the axis of z: from here on s^q is the s^q of the rates times the distance to the power r.
        real away = real_power(real_power(real_abs(rate.x), l.p) + real_power(real_abs(rate.y), l.p), l.q);
        a.slope = product_or_0(rate.x + rate.y < 0 ? -away : away, superell_lower(0, 0, l.r));
    } else {
        a.slope =
            product_or_0(superell_lower(s, outer, l.q), product_or_0(rate.x, a.by_x) + product_or_0(rate.y, a.by_y));
    }
    a.slope = a.slope + product_or_0(rate.z, a.by_z);
    return a;
}

#define SUPERELL_UNDECIDED 0
#define SUPERELL_MONOTONE 1  // or without zeros
#define SUPERELL_BENT 2      // bent to one side: at most one turning point

// What is certain of G between a and b: SUPERELL_MONOTONE, SUPERELL_BENT or SUPERELL_UNDECIDED.
FN int superell_look(superell_ray l, vec3 rate, superell_point a, superell_point b) {
    real low_s = real_min(a.x, b.x) + real_min(a.y, b.y), high_s = real_max(a.x, b.x) + real_max(a.y, b.y);
    real low_power = real_power(low_s, l.q), high_power = real_power(high_s, l.q);
    real by0, by1, bys0, bys1, outer0, outer1, x0, x1, y0, y1, z0, z1, sum0, sum1, square0, square1, least, most;
    if (low_power + (real_min(a.z, b.z) - REAL(1)) > SUPERELL_NOISE) return SUPERELL_MONOTONE;
    if (high_power + (real_max(a.z, b.z) - REAL(1)) < -SUPERELL_NOISE) return SUPERELL_MONOTONE;
    // The slope over r: s^(q-1) (x^(p-1) dx + y^(p-1) dy) + z^(r-1) dz, s = x^p + y^p.
    by0 = superell_lower(low_s, low_power, l.q);
    by1 = superell_lower(high_s, high_power, l.q);
    outer0 = real_min(by0, by1);
    outer1 = real_max(by0, by1);
    x0 = product_or_0(rate.x, a.by_x);
    x1 = product_or_0(rate.x, b.by_x);
    y0 = product_or_0(rate.y, a.by_y);
    y1 = product_or_0(rate.y, b.by_y);
    z0 = product_or_0(rate.z, a.by_z);
    z1 = product_or_0(rate.z, b.by_z);
    sum0 = real_min(x0, x1) + real_min(y0, y1);
    sum1 = real_max(x0, x1) + real_max(y0, y1);
    if (product_or_0(sum0, sum0 > 0 ? outer0 : outer1) + real_min(z0, z1) > 0) return SUPERELL_MONOTONE;
    if (product_or_0(sum1, sum1 > 0 ? outer1 : outer0) + real_max(z0, z1) < 0) return SUPERELL_MONOTONE;
    // The derivative of the slope over r, from the formula at the head of the file.
    square0 = sum0 > 0 ? sum0 * sum0 : sum1 < 0 ? sum1 * sum1 : REAL(0);
    square1 = real_max(sum0 * sum0, sum1 * sum1);
    by0 = superell_lower(low_s, by0, l.q - REAL(1));
    by1 = superell_lower(high_s, by1, l.q - REAL(1));
    bys0 = real_min(by0, by1);
    bys1 = real_max(by0, by1);
    x0 = (l.r - REAL(1)) * square0;
    x1 = (l.r - REAL(1)) * square1;
    y0 = product_or_0(real_min(a.by_xx, b.by_xx), real_min(a.by_yy, b.by_yy));
    y1 = product_or_0(real_max(a.by_xx, b.by_xx), real_max(a.by_yy, b.by_yy));
    y0 = product_or_0((l.p - REAL(1)) * l.twist, y0);
    y1 = product_or_0((l.p - REAL(1)) * l.twist, y1);
    z0 = product_or_0((l.r - REAL(1)) * rate.z * rate.z, a.by_zz);
    z1 = product_or_0((l.r - REAL(1)) * rate.z * rate.z, b.by_zz);
    least = real_min(x0, x1) + real_min(y0, y1);
    most = real_max(x0, x1) + real_max(y0, y1);
    if (product_or_0(least, least > 0 ? bys0 : bys1) + real_min(z0, z1) > 0) return SUPERELL_BENT;
    if (product_or_0(most, most > 0 ? bys1 : bys0) + real_max(z0, z1) < 0) return SUPERELL_BENT;
    return SUPERELL_UNDECIDED;
}

// The root between a and b, where G changes its sign once: Newton's method, kept within the bracket, which is bisected
// whenever two steps did not halve it.
FN real superell_root(superell_ray l, vec3 rate, superell_point a, superell_point b) {
    real low = a.u, high = b.u, u = REAL(0.5) * (low + high), width = REAL_INFINITY;
    u32 negative = a.value < 0;
    int step;
    for (step = 0; step < SUPERELL_ROOT_STEPS; ++step) {
        superell_point m = superell_at(l, rate, u);
        real next;
        if ((m.value < 0) == negative) {
            low = u;
        } else {
            high = u;
        }
        next = u - m.value / (l.r * m.slope);
        if (!(next > low && next < high)) next = REAL(0.5) * (low + high);
        if ((step & 1) && !(high - low <= REAL(0.5) * width)) next = REAL(0.5) * (low + high);
        if (step & 1) width = high - low;
        if (next == u || next <= low || next >= high || real_abs(next - u) < BY_PRECISION(1e-9, 1e-17, 1e-35))
            return next;
        u = next;
    }
    return u;
}

// The point that decides whether G has roots between a and b, where G has the same sign at a and b and bends towards 0.
// The point is one where G has the other sign, or the turning point of G, or any point if the tangents at a and b show
// that G does not reach 0.
FN superell_point superell_turn(superell_ray l, vec3 rate, superell_point a, superell_point b) {
    u32 falling = a.slope < 0, negative = a.value < 0;
    superell_point m = a;
    int step;
    for (step = 0; step < SUPERELL_TURN_STEPS; ++step) {
        real from = l.r * real_abs(a.slope), to = l.r * real_abs(b.slope), u = REAL(0.5) * (a.u + b.u);
        real meet = real_abs(a.value) * to + real_abs(b.value) * from - from * to * (b.u - a.u);
        if (meet > SUPERELL_NOISE * (from + to) || !(u > a.u && u < b.u)) return m;
        m = superell_at(l, rate, u);
        if ((m.value < 0) != negative) return m;
        if ((m.slope < 0) == falling) {
            a = m;
        } else {
            b = m;
        }
    }
    return m;
}

// The crossings between two neighbouring zeros of the coordinates.
FN crossings superell_part(crossings c, superell_ray l, real low, real high, real shift, real length) {
    real middle = REAL(0.5) * (low + high), width = high - low, least = width * SUPERELL_LEAST;
    vec3 rate = make_vec3(superell_rate(l.x, middle), superell_rate(l.y, middle), superell_rate(l.z, middle));
    superell_point a = superell_at(l, rate, low);
    u32 bent = (l.p - REAL(1)) * (l.r - REAL(1)) >= 0;
    int steps = 0;
    while (a.u < high) {
        superell_point b;
        real to = a.u + width;
        int known = SUPERELL_MONOTONE;
        if (!(to < high - least)) to = high;
        b = superell_at(l, rate, to);
        if (bent) {
            known = SUPERELL_BENT;
        } else if (steps < SUPERELL_STEPS && to - a.u > least) {
            known = superell_look(l, rate, a, b);
        }
        if (known == SUPERELL_UNDECIDED) {
            width = REAL(0.5) * (to - a.u);
            ++steps;
            continue;
        }
        if (known == SUPERELL_BENT && (a.value < 0) == (b.value < 0) && (a.slope < 0) != (b.slope < 0) &&
            (a.slope < 0) != (a.value < 0)) {
            superell_point m = superell_turn(l, rate, a, b);
            if ((a.value < 0) != (m.value < 0)) c = cross(c, shift + superell_root(l, rate, a, m) / length, 0);
            a = m;
        }
        if ((a.value < 0) != (b.value < 0)) c = cross(c, shift + superell_root(l, rate, a, b) / length, 0);
        a = b;
        width = REAL(2) * width;
    }
    return c;
}

// The part of `s` with |at + rate u| <= limit.
FN span superell_clip(span s, real at, real rate, real limit) {
    if (rate != 0) {
        real first = (-limit - at) / rate, second = (limit - at) / rate;
        s.low = real_max(s.low, real_min(first, second));
        s.high = real_min(s.high, real_max(first, second));
    } else if (!(real_abs(at) <= limit)) {
        s.high = s.low;
    }
    return s;
}

FN crossings superell_cross(GLOBAL const real* p, ray3 r, crossings c) {
    local_ray l = to_local(p, r);
    real length = real_sqrt(dot3(l.d, l.d));
    vec3 d = scale(l.d, REAL(1) / length);
    span s = whole_line();
    superell_ray ray;
    real knots[5];
    int count = 0, i, k;
    s = superell_clip(s, l.o.x, d.x, SUPERELL_MARGIN);
    s = superell_clip(s, l.o.y, d.y, SUPERELL_MARGIN);
    s = superell_clip(s, l.o.z, d.z, SUPERELL_MARGIN);
    if (!(s.low < s.high)) return c;
    ray.p = p[12];
    ray.q = p[13];
    ray.r = p[14];
    ray.twist = l.o.x * d.y - d.x * l.o.y;
    ray.twist = ray.twist * ray.twist;
    ray.x = superell_axis_of(l.o.x, d.x, s.low, s.high);
    ray.y = superell_axis_of(l.o.y, d.y, s.low, s.high);
    ray.z = superell_axis_of(l.o.z, d.z, s.low, s.high);
    // A ray through the z axis has x and y 0 at once. If rounding put the two zeros apart, the slope of x where x alone
    // is 0 could be infinite, though G does not bend there.
    if (ray.twist == 0 && d.x != 0 && d.y != 0) {
        ray.y.zero = ray.x.zero;
        ray.x.has_zero = ray.y.has_zero = ray.x.has_zero | ray.y.has_zero;
    }
    knots[count++] = s.low;
    if (ray.x.has_zero) knots[count++] = ray.x.zero;
    if (ray.y.has_zero) knots[count++] = ray.y.zero;
    if (ray.z.has_zero) knots[count++] = ray.z.zero;
    for (i = 2; i < count; ++i)
        for (k = i; k > 1 && knots[k] < knots[k - 1]; --k) {
            real swapped = knots[k];
            knots[k] = knots[k - 1];
            knots[k - 1] = swapped;
        }
    knots[count++] = s.high;
    for (i = 0; i + 1 < count; ++i) c = superell_part(c, ray, knots[i], knots[i + 1], l.shift, length);
    return c;
}

// The normal. On a cusp (a coordinate is 0, its exponent below 1) the result is the mean of the normals on both sides.
FN vec3 superell_normal(GLOBAL const real* p, ray3 r, real t) {
    vec3 at = local_point(to_local(p, r), t), n;
    real x = real_abs(at.x), y = real_abs(at.y), z = real_abs(at.z), most;
    real xp = real_power(x, p[12]), yp = real_power(y, p[12]);
    real outer = xp + yp > 0 ? real_power(xp + yp, p[13]) / (xp + yp) : REAL(0);
    n.x = x > 0 ? outer * (xp / x) : REAL(0);
    n.y = y > 0 ? outer * (yp / y) : REAL(0);
    n.z = z > 0 ? real_power(z, p[14]) / z : REAL(0);
    most = real_max(n.x, real_max(n.y, n.z));
    n = scale(n, REAL(1) / most);
    if (at.x < 0) n.x = -n.x;
    if (at.y < 0) n.y = -n.y;
    if (at.z < 0) n.z = -n.z;
    return affine_normal(p, n);
}

#endif
