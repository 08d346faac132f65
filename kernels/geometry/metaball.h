// Metaball. Parameters: affine (12; locally distances are as the fields want them, and everything lies within
// 1 of the origin), method, threshold, and
// for each of `words[first_word]` points x, y, z, then two of its field phi of v, the square of the distance:
//   0  (1 - b v)^2 while b v < 1            unused, b
//   1  a / v                                a, unused
//   2  2^(a - b v)                          a, b
// Surface 0.
//
//   F = threshold - sum of phi < 0
//
// Along the ray v = m + (u - u0)^2 for each point, so its range over a piece is known exactly; phi and its derivatives
// by v are monotone. The ranges of F, F' and F'' are sums of ranges; pieces are walked as in superell.h.
#ifndef CSGRT_GEOMETRY_METABALL_H
#define CSGRT_GEOMETRY_METABALL_H

#include "affine.h"
#include "crossings.h"
#include "power.h"
#include "range.h"

#define METABALL_REACH2            \
    BY_PRECISION(1.0001, 1.000001, \
                 1.000001)  // the searched piece is a little larger than the solid, so its ends are outside
#define METABALL_LEAST BY_PRECISION(0x1p-18, 0x1p-45, 0x1p-90)  // of the piece
#define METABALL_STEPS 2000
#define METABALL_NOISE BY_PRECISION(1e-5, 1e-14, 1e-32)  // in thresholds
#define METABALL_ROOT_STEPS (sizeof(real) == 16 ? 240 : 120)
#define METABALL_POINT 5  // reals

typedef struct {
    GLOBAL const real* points;
    u32 count, method;
    real threshold;
    vec3 o, d;  // d is a unit vector
} metaball_ray;

typedef struct {
    real u, value, slope;
} metaball_point;

// phi and its first two derivatives by v.
typedef struct {
    real value, first, second;
} metaball_field;

FN metaball_field metaball_phi(u32 method, real a, real b, real v) {
    metaball_field f;
    if (method == 1) {
        f.value = a / v;
        f.first = -f.value / v;
        f.second = REAL(-2) * f.first / v;
    } else if (method == 2) {
        f.value = exp_2(real_fma(-b, v, a));
        f.first = REAL(-0.6931471805599453) * b * f.value;
        f.second = REAL(-0.6931471805599453) * b * f.first;
    } else {
        real rest = real_max(REAL(0), real_fma(-b, v, REAL(1)));
        f.value = rest * rest;
        f.first = REAL(-2) * b * rest;
        f.second = rest > 0 ? REAL(2) * b * b : REAL(0);
    }
    return f;
}

// Of one point: where along the ray it is nearest, and the square of that distance.
typedef struct {
    real at, least;
} metaball_pass;

FN metaball_pass metaball_pass_of(metaball_ray l, u32 i) {
    GLOBAL const real* p = l.points + METABALL_POINT * i;
    vec3 o = make_vec3(l.o.x - p[0], l.o.y - p[1], l.o.z - p[2]);
    real x = difference_of_products(o.y, l.d.z, o.z, l.d.y);
    real y = difference_of_products(o.z, l.d.x, o.x, l.d.z);
    real z = difference_of_products(o.x, l.d.y, o.y, l.d.x);
    metaball_pass pass;
    pass.at = -dot3(o, l.d);
    pass.least = dot3(make_vec3(x, y, z), make_vec3(x, y, z));
    return pass;
}

FN metaball_point metaball_at(metaball_ray l, real u) {
    metaball_point p;
    u32 i;
    p.u = u;
    p.value = l.threshold;
    p.slope = 0;
    for (i = 0; i < l.count; ++i) {
        metaball_pass pass = metaball_pass_of(l, i);
        real from = u - pass.at;
        metaball_field f = metaball_phi(l.method, l.points[METABALL_POINT * i + 3], l.points[METABALL_POINT * i + 4],
                                        real_fma(from, from, pass.least));
        p.value = p.value - f.value;
        p.slope = p.slope - REAL(2) * product_or_0(from, f.first);
    }
    return p;
}

#define METABALL_UNDECIDED 0
#define METABALL_MONOTONE 1  // or free of zeros
#define METABALL_BENT 2      // turns once at most

FN int metaball_look(metaball_ray l, real a, real b) {
    range value, slope, bend;
    u32 i;
    value.low = value.high = l.threshold;
    slope.low = slope.high = bend.low = bend.high = 0;
    for (i = 0; i < l.count; ++i) {
        metaball_pass pass = metaball_pass_of(l, i);
        range from = range_between(a - pass.at, b - pass.at), square = range_square(from);
        real p3 = l.points[METABALL_POINT * i + 3], p4 = l.points[METABALL_POINT * i + 4];
        metaball_field near = metaball_phi(l.method, p3, p4, pass.least + square.low);
        metaball_field far = metaball_phi(l.method, p3, p4, pass.least + square.high);
        range first = range_between(near.first, far.first), second = range_between(near.second, far.second);
        value.low = value.low - near.value;
        value.high = value.high - far.value;
        // F' = - sum of 2 from phi', F'' = - sum of 2 phi' + 4 from^2 phi''
        slope = range_sum(slope, range_scaled(range_product(from, first), REAL(-2)));
        bend = range_sum(bend, range_scaled(first, REAL(-2)));
        bend = range_sum(bend, range_scaled(range_product(square, second), REAL(-4)));
    }
    if (value.low > METABALL_NOISE * l.threshold || value.high < -METABALL_NOISE * l.threshold)
        return METABALL_MONOTONE;
    if (!range_has_0(slope)) return METABALL_MONOTONE;
    return range_has_0(bend) ? METABALL_UNDECIDED : METABALL_BENT;
}

// The root between a and b, where F changes its sign once; see superell_root.
FN real metaball_root(metaball_ray l, metaball_point a, metaball_point b) {
    real low = a.u, high = b.u, u = REAL(0.5) * (low + high), width = REAL_INFINITY;
    u32 negative = a.value < 0;
    int step;
    for (step = 0; step < METABALL_ROOT_STEPS; ++step) {
        metaball_point m = metaball_at(l, u);
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

FN metaball_point metaball_turn(metaball_ray l, metaball_point a, metaball_point b) {
    real low = a.u, high = b.u;
    u32 falling = a.slope < 0;
    metaball_point m = a;
    int step;
    for (step = 0; step < 60; ++step) {
        real u = REAL(0.5) * (low + high);
        if (!(u > low && u < high)) return m;
        m = metaball_at(l, u);
        if ((m.slope < 0) == falling) {
            low = u;
        } else {
            high = u;
        }
    }
    return m;
}

FN crossings metaball_cross(Geometry g, SolidRecord solid, ray3 r, crossings c) {
    GLOBAL const real* p = g.reals + solid.first_real;
    local_ray l = to_local(p, r);
    real length = real_sqrt(dot3(l.d, l.d)), reach2 = METABALL_REACH2 - dot3(l.o, l.o), width, least, high;
    metaball_ray ray;
    metaball_point a;
    int steps = 0;
    if (!(reach2 > 0)) return c;
    ray.points = p + 14;
    ray.count = g.words[solid.first_word];
    ray.method = (u32)p[12];
    ray.threshold = p[13];
    ray.o = l.o;
    ray.d = scale(l.d, REAL(1) / length);
    high = real_sqrt(reach2);
    width = REAL(2) * high;
    least = width * METABALL_LEAST;
    a = metaball_at(ray, -high);
    while (a.u < high) {
        metaball_point b;
        real to = a.u + width;
        int known = METABALL_MONOTONE;
        if (!(to < high - least)) to = high;
        if (steps < METABALL_STEPS && to - a.u > least) known = metaball_look(ray, a.u, to);
        if (known == METABALL_UNDECIDED) {
            width = REAL(0.5) * (to - a.u);
            ++steps;
            continue;
        }
        b = metaball_at(ray, to);
        if (known == METABALL_BENT && (a.slope < 0) != (b.slope < 0)) {
            metaball_point m = metaball_turn(ray, a, b);
            if ((a.value < 0) != (m.value < 0)) c = cross(c, l.shift + metaball_root(ray, a, m) / length, 0);
            a = m;
        }
        if ((a.value < 0) != (b.value < 0)) c = cross(c, l.shift + metaball_root(ray, a, b) / length, 0);
        a = b;
        width = REAL(2) * width;
    }
    return c;
}

FN vec3 metaball_normal(Geometry g, SolidRecord solid, ray3 r, real t) {
    GLOBAL const real* p = g.reals + solid.first_real;
    vec3 at = local_point(to_local(p, r), t), n = make_vec3(0, 0, 0);
    u32 i, count = g.words[solid.first_word], method = (u32)p[12];
    for (i = 0; i < count; ++i) {
        GLOBAL const real* q = p + 14 + METABALL_POINT * i;
        vec3 from = make_vec3(at.x - q[0], at.y - q[1], at.z - q[2]);
        n = add_scaled(n, -metaball_phi(method, q[3], q[4], dot3(from, from)).first, from);
    }
    return affine_normal(p, n);
}

#endif
