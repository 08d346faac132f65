// Heart. Parameters: affine (12). Surface 0.
//
//   (x^2 + 9/4 y^2 + z^2 - 1)^3 - x^2 z^3 - 9/80 y^2 z^3 < 0
//
// The gradient of this function is 0 all along the ellipse A = 0 = z. The same heart is
//
//   F = A - z B^(1/3) < 0,   A = x^2 + 9/4 y^2 + z^2 - 1,  B = x^2 + 9/80 y^2
//
// whose gradient is not 0 almost everywhere: only the dimples on the z axis are pointed.
//
// The ray is cut where A or B is least and where z is 0. On each part A, A', B, B' and z are monotone. So the ranges of
// F and of its derivatives follow from the values at the two limits of an interval. Intervals are walked as in
// superell.h.
#ifndef CSGRT_GEOMETRY_HRT_H
#define CSGRT_GEOMETRY_HRT_H

#include "affine.h"
#include "crossings.h"
#include "power.h"
#include "range.h"

#define HRT_Y REAL(2.25)
#define HRT_DIMPLE_Y REAL(0.1125)
#define HRT_LEAST BY_PRECISION(0x1p-18, 0x1p-45, 0x1p-90)  // of a part
#define HRT_STEPS 500
#define HRT_NOISE BY_PRECISION(1e-5, 1e-14, 1e-32)
#define HRT_ROOT_STEPS (sizeof(real) == 16 ? 240 : 120)

// A and B along a ray: parabolas in the ray's parameter u; z is linear in it.
typedef struct {
    real a_least, a_at, a_rate;  // A = a_least + a_rate (u - a_at)^2
    real b_least, b_at, b_rate;  // B likewise
    real z, z_rate, z_zero;      // z_zero: where z is 0, if it is in the searched interval
    u32 has_zero;
} hrt_ray;

// The values at one position u of the ray.
typedef struct {
    real u, value, slope;
    real a, a_slope, z;
    real root, root_slope;             // B^(1/3) and its rate of change
    real b_slope, by_root2, by_root5;  // B', 1 / root^2, 1 / root^5
} hrt_point;

FN hrt_point hrt_at(hrt_ray l, real u) {
    hrt_point p;
    real from_a = u - l.a_at, from_b = u - l.b_at;
    p.u = u;
    p.a = real_fma(l.a_rate * from_a, from_a, l.a_least);
    p.a_slope = REAL(2) * l.a_rate * from_a;
    p.z = l.has_zero ? l.z_rate * (u - l.z_zero) : real_fma(l.z_rate, u, l.z);
    p.root = cube_root(real_fma(l.b_rate * from_b, from_b, l.b_least));
    p.b_slope = REAL(2) * l.b_rate * from_b;
    p.by_root2 = REAL(1) / (p.root * p.root);
    p.by_root5 = p.by_root2 * p.by_root2 / p.root;
    p.root_slope = product_or_0(p.b_slope, p.by_root2) / REAL(3);
    p.value = real_fma(-p.z, p.root, p.a);
    p.slope = p.a_slope - l.z_rate * p.root - product_or_0(p.z, p.root_slope);
    return p;
}

#define HRT_UNDECIDED 0
#define HRT_MONOTONE 1  // or without zeros
#define HRT_BENT 2      // at most one turning point

FN int hrt_look(hrt_ray l, hrt_point a, hrt_point b) {
    range z = range_between(a.z, b.z), root = range_between(a.root, b.root);
    range b_slope = range_between(a.b_slope, b.b_slope), by_root2 = range_between(a.by_root2, b.by_root2);
    range value = range_sum(range_between(a.a, b.a), range_scaled(range_product(z, root), REAL(-1)));
    range root_slope, slope, bend, of_root;
    if (value.low > HRT_NOISE || value.high < -HRT_NOISE) return HRT_MONOTONE;
    root_slope = range_scaled(range_product(b_slope, by_root2), REAL(1) / REAL(3));
    slope = range_sum(range_between(a.a_slope, b.a_slope), range_scaled(root, -l.z_rate));
    slope = range_sum(slope, range_scaled(range_product(z, root_slope), REAL(-1)));
    if (!range_has_0(slope)) return HRT_MONOTONE;
    // root'' = B'' / (3 root^2) - 2/9 B'^2 / root^5
    of_root =
        range_scaled(range_product(range_square(b_slope), range_between(a.by_root5, b.by_root5)), REAL(-2) / REAL(9));
    of_root = range_sum(of_root, range_scaled(by_root2, REAL(2) / REAL(3) * l.b_rate));
    bend = range_sum(range_scaled(root_slope, REAL(-2) * l.z_rate), range_scaled(range_product(z, of_root), REAL(-1)));
    bend.low = bend.low + REAL(2) * l.a_rate;
    bend.high = bend.high + REAL(2) * l.a_rate;
    return range_has_0(bend) ? HRT_UNDECIDED : HRT_BENT;
}

// The root between a and b, where F changes its sign once; see superell_root.
FN real hrt_root(hrt_ray l, hrt_point a, hrt_point b) {
    real low = a.u, high = b.u, u = REAL(0.5) * (low + high), width = REAL_INFINITY;
    u32 negative = a.value < 0;
    int step;
    for (step = 0; step < HRT_ROOT_STEPS; ++step) {
        hrt_point m = hrt_at(l, u);
        real next = u - m.value / m.slope;
        if ((m.value < 0) == negative) {
            low = u;
        } else {
            high = u;
        }
        if (!(next > low && next < high)) next = REAL(0.5) * (low + high);
        if ((step & 1) && !(high - low <= REAL(0.5) * width)) next = REAL(0.5) * (low + high);
        if (step & 1) width = high - low;
        if (next == u || next <= low || next >= high || real_abs(next - u) < BY_PRECISION(1e-9, 1e-17, 1e-35))
            return next;
        u = next;
    }
    return u;
}

FN hrt_point hrt_turn(hrt_ray l, hrt_point a, hrt_point b) {
    real low = a.u, high = b.u;
    u32 falling = a.slope < 0;
    hrt_point m = a;
    int step;
    for (step = 0; step < 60; ++step) {
        real u = REAL(0.5) * (low + high);
        if (!(u > low && u < high)) return m;
        m = hrt_at(l, u);
        if ((m.slope < 0) == falling) {
            low = u;
        } else {
            high = u;
        }
    }
    return m;
}

FN crossings hrt_part(crossings c, hrt_ray l, real low, real high, real shift, real length) {
    real width = high - low, least = width * HRT_LEAST;
    hrt_point a = hrt_at(l, low);
    int steps = 0;
    while (a.u < high) {
        hrt_point b;
        real to = a.u + width;
        int known = HRT_MONOTONE;
        if (!(to < high - least)) to = high;
        b = hrt_at(l, to);
        if (steps < HRT_STEPS && to - a.u > least) known = hrt_look(l, a, b);
        if (known == HRT_UNDECIDED) {
            width = REAL(0.5) * (to - a.u);
            ++steps;
            continue;
        }
        if (known == HRT_BENT && (a.slope < 0) != (b.slope < 0)) {
            hrt_point m = hrt_turn(l, a, b);
            if ((a.value < 0) != (m.value < 0)) c = cross(c, shift + hrt_root(l, a, m) / length, 0);
            a = m;
        }
        if ((a.value < 0) != (b.value < 0)) c = cross(c, shift + hrt_root(l, a, b) / length, 0);
        a = b;
        width = REAL(2) * width;
    }
    return c;
}

// The part of `s` with low <= at + rate u <= high.
FN span hrt_clip(span s, real at, real rate, real low, real high) {
    if (rate != 0) {
        real first = (low - at) / rate, second = (high - at) / rate;
        s.low = real_max(s.low, real_min(first, second));
        s.high = real_min(s.high, real_max(first, second));
    } else if (!(at >= low && at <= high)) {
        s.high = s.low;
    }
    return s;
}

// The heart lies within |x| < 1.14, |y| < 0.67 and -1 < z < 1.24. The searched box is larger, so that both limits are
// outside.
FN crossings hrt_cross(GLOBAL const real* p, ray3 r, crossings c) {
    local_ray l = to_local(p, r);
    real length = real_sqrt(dot3(l.d, l.d));
    vec3 d = scale(l.d, REAL(1) / length);
    span s = whole_line();
    hrt_ray ray;
    real knots[5], cuts[3];
    int count = 0, i, k;
    s = hrt_clip(s, l.o.x, d.x, REAL(-1.1875), REAL(1.1875));
    s = hrt_clip(s, l.o.y, d.y, REAL(-0.75), REAL(0.75));
    s = hrt_clip(s, l.o.z, d.z, REAL(-1.0625), REAL(1.3125));
    if (!(s.low < s.high)) return c;
    {
        real y = REAL(1.5) * l.o.y, dy = REAL(1.5) * d.y;
        real xy = difference_of_products(l.o.x, dy, y, d.x), yz = difference_of_products(y, d.z, l.o.z, dy);
        real zx = difference_of_products(l.o.z, d.x, l.o.x, d.z);
        ray.a_rate = real_fma(d.x, d.x, real_fma(dy, dy, d.z * d.z));
        ray.a_at = -real_fma(l.o.x, d.x, real_fma(y, dy, l.o.z * d.z)) / ray.a_rate;
        ray.a_least = real_fma(xy, xy, real_fma(yz, yz, zx * zx)) / ray.a_rate - REAL(1);
    }
    {
        real cross = difference_of_products(l.o.x, d.y, l.o.y, d.x);
        ray.b_rate = real_fma(d.x, d.x, HRT_DIMPLE_Y * d.y * d.y);
        if (ray.b_rate > REAL(1e-30)) {
            ray.b_at = -real_fma(l.o.x, d.x, HRT_DIMPLE_Y * l.o.y * d.y) / ray.b_rate;
            ray.b_least = HRT_DIMPLE_Y * cross * cross / ray.b_rate;
        } else {
            ray.b_rate = 0;
            ray.b_at = REAL(-8);  // along the axis B is constant, and has no least value in the interval
            ray.b_least = real_fma(l.o.x, l.o.x, HRT_DIMPLE_Y * l.o.y * l.o.y);
        }
    }
    ray.z = l.o.z;
    ray.z_rate = d.z;
    ray.z_zero = -l.o.z / d.z;
    ray.has_zero = ray.z_zero > s.low && ray.z_zero < s.high;
    cuts[0] = ray.a_at;
    cuts[1] = ray.b_at;
    cuts[2] = ray.z_zero;
    knots[count++] = s.low;
    for (i = 0; i < 3; ++i)
        if (cuts[i] > s.low && cuts[i] < s.high) {
            for (k = count; k > 1 && knots[k - 1] > cuts[i]; --k) knots[k] = knots[k - 1];
            knots[k] = cuts[i];
            ++count;
        }
    knots[count++] = s.high;
    for (i = 0; i + 1 < count; ++i) c = hrt_part(c, ray, knots[i], knots[i + 1], l.shift, length);
    return c;
}

FN vec3 hrt_normal(GLOBAL const real* p, ray3 r, real t) {
    vec3 at = local_point(to_local(p, r), t);
    real root = cube_root(real_fma(at.x, at.x, HRT_DIMPLE_Y * at.y * at.y));
    real dimple = root > 0 ? at.z / (REAL(1.5) * root * root) : REAL(0);
    return affine_normal(p, make_vec3((REAL(2) - dimple) * at.x, (REAL(2) * HRT_Y - HRT_DIMPLE_Y * dimple) * at.y,
                                      REAL(2) * at.z - root));
}

#endif
