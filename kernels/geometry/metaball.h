// Metaball. Parameters: affine (12; local distances are scaled for the fields, and everything lies within 1 of the
// origin), method, threshold, faint, and for each point x, y, z, then two parameters of its field phi of v, the square
// of the distance:
//
//   0  (1 - b v)^2 while b v < 1                  unused, b
//   1  a / v                                      a, unused
//   2  2^(a - b v) while a - b v > faint          a, b
//
// Words: the number of points, the position in inner_nodes of the hierarchy over the balls in which their fields are
// not 0, and the number of its nodes (0: none). Surface 0.
//
//   F = threshold - sum of phi < 0
//
// Along the ray v = m + (u - u0)^2 for each point, so the range of v over an interval is known exactly. phi and its
// derivatives by v are monotone. The ranges of F, F' and F'' are sums of ranges; intervals are walked as in superell.h.
// The sums leave out points whose balls the interval does not meet, so a ray past n balls takes n log n steps.
#ifndef CSGRT_GEOMETRY_METABALL_H
#define CSGRT_GEOMETRY_METABALL_H

#include "../traversal/bvh_cursor.h"
#include "affine.h"
#include "crossings.h"
#include "power.h"
#include "range.h"

#define METABALL_REACH2            \
    BY_PRECISION(1.0001, 1.000001, \
                 1.000001)  // the searched interval is a little larger than the solid, so both its limits are outside
#define METABALL_LEAST BY_PRECISION(0x1p-18, 0x1p-45, 0x1p-90)  // of the interval
// The number of halvings that decide nothing, for the solid and for each point, before the least interval becomes
// METABALL_COARSER times as large. Without this limit halving would not end where F is 0 all along the ray except for
// rounding. The rest of the ray is still searched.
#define METABALL_STEPS 500
#define METABALL_POINT_STEPS 64
#define METABALL_COARSER 32
#define METABALL_NOISE BY_PRECISION(1e-5, 1e-14, 1e-32)  // in thresholds
#define METABALL_TURN_STEPS (sizeof(real) == 16 ? 120 : 60)
#define METABALL_ROOT_STEPS (sizeof(real) == 16 ? 240 : 120)
#define METABALL_SETTLED BY_PRECISION(1e-7, 1e-16, 1e-34)  // the last step of Newton's method at a root
#define METABALL_POINTS 15                                 // where the points begin
#define METABALL_POINT 5                                   // reals a point

// A ray in a metaball's local space, with the metaball's points.
typedef struct {
    GLOBAL const real* points;
    GLOBAL const BvhNode* nodes;
    u32 count, node_count, method;
    real threshold, faint;
    vec3 o, d;  // d is a unit vector
    slab_ray slab;
} metaball_ray;

// F and its slope at one position u of the ray.
typedef struct {
    real u, value, slope;
} metaball_point;

// phi and its first two derivatives by v.
typedef struct {
    real value, first, second;
} metaball_field;

FN metaball_field metaball_field_of(metaball_ray l, u32 i, real v) {
    GLOBAL const real* p = l.points + METABALL_POINT * (size_t)i;
    const real a = p[3], b = p[4];
    metaball_field f;
    if (l.method == 1) {
        f.value = a / v;
        f.first = -f.value / v;
        f.second = REAL(-2) * f.first / v;
    } else if (l.method == 2) {
        real power = real_fma(-b, v, a);
        f.value = power > l.faint ? exp_2(power) : REAL(0);
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

FN metaball_ray metaball_ray_of(Geometry g, SolidRecord solid, vec3 o, vec3 d) {
    GLOBAL const real* p = g.reals + solid.first_real;
    GLOBAL const u32* words = g.words + solid.first_word;
    metaball_ray l;
    l.points = p + METABALL_POINTS;
    l.count = words[0];
    l.nodes = g.inner_nodes + words[1];
    l.node_count = words[2];
    l.method = (u32)p[12];
    l.threshold = p[13];
    l.faint = p[14];
    l.o = o;
    l.d = d;
    l.slab = make_slab_ray(offset_from(widen(make_vec3(0, 0, 0)), widen(o)), d, 1, -REAL_INFINITY);
    return l;
}

// The walk through the points whose fields may not be 0 in an interval of the ray, in order.
typedef struct {
    bvh_cursor cursor;
    single from, to;
    u32 next, last;  // points of the leaf that are left
} metaball_walk;

FN metaball_walk metaball_near(metaball_ray l, real from, real to) {
    metaball_walk w;
    w.cursor = bvh_over(l.node_count);
    w.from = to_single(from - SLAB_SLACK);
    w.to = to_single(to + SLAB_SLACK);
    w.next = 0;
    w.last = l.node_count ? 0 : l.count;
    return w;
}
FN u32 metaball_next(metaball_ray l, metaball_walk* w) {
    while (w->next == w->last) {
        BvhNode node;
        single in, out;
        u32 leaf;
        if (!bvh_goes_on(w->cursor)) return NONE;
        node = l.nodes[w->cursor.node];
        in = box_passage(l.slab, node, &out);
        leaf = bvh_step(&w->cursor, node, in <= single_min(out, w->to) && out >= w->from);
        w->next = leaf >> BVH_LEAF_SHIFT;
        w->last = w->next + (leaf & BVH_LEAF_MASK);
    }
    return w->next++;
}

// The position of the ray that is nearest to a point, and the square of the distance there.
typedef struct {
    real at, least;
} metaball_pass;

FN metaball_pass metaball_pass_of(metaball_ray l, u32 i) {
    GLOBAL const real* p = l.points + METABALL_POINT * (size_t)i;
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
    metaball_walk w = metaball_near(l, u, u);
    metaball_point p;
    u32 i;
    p.u = u;
    p.value = l.threshold;
    p.slope = 0;
    while ((i = metaball_next(l, &w)) != NONE) {
        metaball_pass pass = metaball_pass_of(l, i);
        real from = u - pass.at;
        metaball_field f = metaball_field_of(l, i, real_fma(from, from, pass.least));
        p.value = p.value - f.value;
        p.slope = p.slope - REAL(2) * product_or_0(from, f.first);
    }
    return p;
}

#define METABALL_UNDECIDED 0
#define METABALL_MONOTONE 1  // or without zeros
#define METABALL_BENT 2      // at most one turning point

FN int metaball_look(metaball_ray l, real a, real b) {
    metaball_walk w = metaball_near(l, a, b);
    range value, slope, bend;
    u32 i;
    value.low = value.high = l.threshold;
    slope.low = slope.high = bend.low = bend.high = 0;
    while ((i = metaball_next(l, &w)) != NONE) {
        metaball_pass pass = metaball_pass_of(l, i);
        range from = range_between(a - pass.at, b - pass.at), square = range_square(from);
        metaball_field near = metaball_field_of(l, i, pass.least + square.low);
        metaball_field far = metaball_field_of(l, i, pass.least + square.high);
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

// The root between a and b, where F changes its sign once: Newton's method, and halving where a step leaves the bracket
// or does not halve the step before.
FN real metaball_root(metaball_ray l, metaball_point a, metaball_point b) {
    real low = a.u, high = b.u, u = REAL(0.5) * (low + high), last = high - low, before = last;
    u32 negative = a.value < 0;
    int step;
    for (step = 0; step < METABALL_ROOT_STEPS; ++step) {
        metaball_point m = metaball_at(l, u);
        real next = u - m.value / m.slope;
        if (real_abs(next - u) < METABALL_SETTLED) return next;
        if ((m.value < 0) == negative) {
            low = u;
        } else {
            high = u;
        }
        if (!(next > low && next < high && real_abs(next - u) <= REAL(0.5) * before)) next = REAL(0.5) * (low + high);
        if (!(next > low && next < high)) return next;
        before = last;
        last = real_abs(next - u);
        u = next;
    }
    return u;
}

// The turning point between a and b, where F has one sign and bends towards 0: see superell_turn.
FN metaball_point metaball_turn(metaball_ray l, metaball_point a, metaball_point b) {
    u32 falling = a.slope < 0, negative = a.value < 0;
    metaball_point m = a;
    int step;
    for (step = 0; step < METABALL_TURN_STEPS; ++step) {
        real from = real_abs(a.slope), to = real_abs(b.slope), u = REAL(0.5) * (a.u + b.u);
        real meet = real_abs(a.value) * to + real_abs(b.value) * from - from * to * (b.u - a.u);
        if (meet > METABALL_NOISE * l.threshold * (from + to) || !(u > a.u && u < b.u)) return m;
        m = metaball_at(l, u);
        if ((m.value < 0) != negative) return m;
        if ((m.slope < 0) == falling) {
            a = m;
        } else {
            b = m;
        }
    }
    return m;
}

FN crossings metaball_cross(Geometry g, SolidRecord solid, ray3 r, crossings c) {
    local_ray l = to_local(g.reals + solid.first_real, r);
    real length = real_sqrt(dot3(l.d, l.d)), reach2 = METABALL_REACH2 - dot3(l.o, l.o), width, least, high;
    metaball_ray ray;
    metaball_point a;
    u32 steps, most;
    if (!(reach2 > 0)) return c;
    ray = metaball_ray_of(g, solid, l.o, scale(l.d, REAL(1) / length));
    steps = most = METABALL_STEPS + METABALL_POINT_STEPS * ray.count;
    high = real_sqrt(reach2);
    width = REAL(2) * high;
    least = width * METABALL_LEAST;
    a = metaball_at(ray, -high);
    while (a.u < high) {
        metaball_point b;
        real to = a.u + width;
        int known = METABALL_MONOTONE;
        if (!(to < high - least)) to = high;
        if (to - a.u > least) known = metaball_look(ray, a.u, to);
        if (known == METABALL_UNDECIDED) {
            width = REAL(0.5) * (to - a.u);
            if (--steps == 0) {
                least = METABALL_COARSER * least;
                steps = most;
            }
            continue;
        }
        b = metaball_at(ray, to);
        if (known == METABALL_BENT && (a.value < 0) == (b.value < 0) && (a.slope < 0) != (b.slope < 0) &&
            (a.slope < 0) != (a.value < 0)) {
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
    local_ray l = to_local(p, r);
    real length = real_sqrt(dot3(l.d, l.d)), u = (t - l.shift) * length;
    metaball_ray ray = metaball_ray_of(g, solid, l.o, scale(l.d, REAL(1) / length));
    metaball_walk w = metaball_near(ray, u, u);
    vec3 at = local_point(l, t), n = make_vec3(0, 0, 0);
    u32 i;
    while ((i = metaball_next(ray, &w)) != NONE) {
        GLOBAL const real* q = ray.points + METABALL_POINT * (size_t)i;
        vec3 from = make_vec3(at.x - q[0], at.y - q[1], at.z - q[2]);
        n = add_scaled(n, -metaball_field_of(ray, i, dot3(from, from)).first, from);
    }
    return affine_normal(p, n);
}

#endif
