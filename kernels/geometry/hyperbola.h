// Hyperbola: finds where a ray crosses the surface that a line or curve sweeps about an axis.
//
// Turned into the half plane of the curve, the ray is a hyperbola: at height z its distance from the axis is
//
//     rho(z)^2 = p^2 + x(z)^2,   x(z) = q + (z - oz) across / dz     p: the ray's distance from the axis
//
// A curve crosses the hyperbola where f = dz^2 (r^2 - p^2) - (dz q + (z - oz) across)^2 changes its sign. f is a
// polynomial of twice the curve's degree. It is positive where the curve is farther from the axis than the ray, and has
// the same value at a vertex for both curves that meet there.
//
//     z |   \      |       flat rays (dz small): the hyperbola closes to the line z = oz, run through twice
//       |    \     |
//       |     )  .-x-.     Between its two arms f is positive only within about dz of that line. So each curve is split
//       |    /  (  |  )    where it crosses z = oz, where f has the sign of r - p, known however small dz is: then
//       |   /    `-x-'     there is one crossing on each arm, or none.
//       +---------------- r
//
// Points on the axis count as nearer to the axis than any ray, so an outline may end there.
#ifndef CSGRT_GEOMETRY_HYPERBOLA_H
#define CSGRT_GEOMETRY_HYPERBOLA_H

#include "affine.h"
#include "bernstein.h"
#include "curve.h"
#include "polynomial.h"

#define FLAT_RAY REAL(0.5)                           // rays whose unit direction has a smaller |dz| are flat
#define FAINT REAL(1e-37)                            // greater than 0 and less than any rounding of f
#define POLISH_REACH BY_PRECISION(1e-3, 1e-6, 1e-6)  // the longest step of the last polish

// The ray about the axis, in a unit direction: at s its height is oz + s dz and x = q + s across.
typedef struct {
    real shift, speed;  // t = shift + s / speed
    real dz, across, p, q, oz;
    int flat;  // 1: s is 0 where the ray passes the axis, so q is 0
} axis_ray;

FN axis_ray around_axis(local_ray l) {
    axis_ray a;
    vec3 d;
    a.speed = real_sqrt(dot3(l.d, l.d));
    d = scale(l.d, REAL(1) / a.speed);
    a.shift = l.shift;
    a.dz = d.z;
    a.across = real_sqrt(real_fma(d.x, d.x, d.y * d.y));
    if (a.across > 0) {
        real x = d.x / a.across, y = d.y / a.across;
        a.p = real_abs(difference_of_products(l.o.x, y, l.o.y, x));
        a.q = real_fma(l.o.x, x, l.o.y * y);
    } else {
        a.p = real_abs(l.o.y);
        a.q = l.o.x;
    }
    a.oz = l.o.z;
    a.flat = real_abs(a.dz) < FLAT_RAY;
    if (a.flat) {
        real s = -a.q / a.across;
        a.shift = a.shift + s / a.speed;
        a.oz = real_fma(s, a.dz, a.oz);
        a.q = 0;
    }
    return a;
}

// A point of a curve: radius, height, and their derivatives.
typedef struct {
    real r, z, dr, dz;
} profile_point;

FN profile_point profile_at(GLOBAL const real* p, u32 degree, u32 stride, real t) {
    profile_point at;
    if (degree == 1) {
        at.dr = p[stride] - p[0];
        at.dz = p[stride + 1] - p[1];
        at.r = blend(t, p[0], p[stride]);
        at.z = blend(t, p[1], p[stride + 1]);
    } else {
        curve_point c = curve_at(p, degree, t);
        at.r = c.x / c.w;
        at.z = c.y / c.w;
        at.dr = real_fma(-at.r, c.dw, c.dx) / c.w;
        at.dz = real_fma(-at.z, c.dw, c.dy) / c.w;
    }
    return at;
}

// The polynomial f of a curve, in Bernstein form: products of linear forms of its control points. The values at 0 and 1
// are one difference of products each. They are the same for every curve with the same end point.
FN void radial_form(GLOBAL const real* p, u32 degree, u32 stride, axis_ray a, real* f) {
    real less[CURVE_SIZE], more[CURVE_SIZE], x[CURVE_SIZE];  // each times the binomial coefficient
    real binomial = 1;
    u32 i, k;
    for (i = 0; i <= degree; ++i) {
        real w = stride == 3 ? p[stride * i + 2] * binomial : binomial;
        real r = p[stride * i], z = p[stride * i + 1];
        less[i] = w * (a.dz * (r - a.p));
        more[i] = w * (a.dz * (r + a.p));
        x[i] = w * real_fma(z - a.oz, a.across, a.dz * a.q);
        binomial = binomial * REAL(degree - i) / REAL(i + 1u);
    }
    binomial = 1;
    for (k = 0; k <= 2 * degree; ++k) {
        u32 first = k > degree ? k - degree : 0;
        real sum = 0;
        for (i = first; i <= degree && i <= k; ++i)
            sum = sum + difference_of_products(less[i], more[k - i], x[i], x[k - i]);
        f[k] = sum / binomial;
        binomial = binomial * REAL(2 * degree - k) / REAL(k + 1u);
    }
}

FN int radial_sign(axis_ray a, real f, real r, real z) { return a.flat && z == a.oz ? r > a.p : f > 0; }

// The crossing in [low, high] of a curve, where f changes its sign from `positive`, and its distance along the ray.
// `arm`: the arm of the hyperbola on which a flat ray is met; it has the sign of s.
typedef struct {
    real at, s;
    int within;  // of a flat ray: the curve is no farther from the axis here than the ray's closest point
} radial_root;

FN radial_root root_of_form(GLOBAL const real* p, u32 degree, u32 stride, axis_ray a, bracket b, real arm) {
    radial_root root;
    int step;
    profile_point c = profile_at(p, degree, stride, b.at);
    for (step = 0; step < BRACKET_STEPS && !b.done; ++step) {
        real h = c.z - a.oz, value, slope;
        real room = real_fma(c.r - a.p, c.r + a.p, REAL(0));
        if (a.flat) {
            // |dz| sqrt(r^2 - p^2) - |h| across, which has f's sign and does not vanish with dz
            real reach = room > 0 ? real_sqrt(room) : REAL(0);
            value = real_fma(real_abs(a.dz), reach, -real_abs(h) * a.across);
            slope = h > 0 ? -c.dz * a.across : c.dz * a.across;
            if (reach > 0) slope = real_fma(real_abs(a.dz), c.r * c.dr / reach, slope);
        } else {
            real x = real_fma(h, a.across, a.dz * a.q);
            value = real_fma(a.dz * a.dz, room, -x * x);
            slope = REAL(2) * real_fma(a.dz * a.dz, c.r * c.dr, -x * (c.dz * a.across));
        }
        b = newton_step(b, value, slope);
        c = profile_at(p, degree, stride, b.at);
    }
    root.at = b.at;
    root.within = 0;
    if (!a.flat) {
        root.s = (c.z - a.oz) / a.dz;
        return root;
    }
    {
        real room = (c.r - a.p) * (c.r + a.p);
        root.s = room > 0 ? arm * real_sqrt(room) / a.across : REAL(0);
        root.within = !(room > 0);
    }
    // Where the curve leaves the hyperbola's vertex the root of `room` has few digits, though the crossing may be
    // sharp: z = oz + s dz and r^2 = p^2 + (s across)^2, by Newton's method in the two unknowns.
    for (step = 0; step < 2; ++step) {
        real height = (c.z - a.oz) - root.s * a.dz;
        real x = root.s * a.across;
        real radial = real_fma(c.r - a.p, c.r + a.p, -x * x);
        real determinant = REAL(2) * difference_of_products(a.dz, c.r * c.dr, c.dz, x * a.across);
        real by_s = difference_of_products(REAL(2) * (c.r * c.dr), height, c.dz, radial) / determinant;
        real by_t = (a.dz * radial - REAL(2) * (x * a.across) * height) / determinant;
        real next = root.at - by_t;
        if (!(real_abs(by_s) < POLISH_REACH && real_abs(by_t) < POLISH_REACH && next >= 0 && next <= 1)) return root;
        root.at = next;
        root.s = root.s + by_s;
        c = profile_at(p, degree, stride, next);
    }
    return root;
}

// The crossings of one curve, one after the other. A split is where the curve crosses z = oz; f is evaluated between
// two neighbouring splits.
typedef struct {
    GLOBAL const real* p;
    u32 degree, stride;
    real f[BERNSTEIN_SIZE], part[BERNSTEIN_SIZE];  // f on [0, 1], and on [low, high]
    real level[CURVE_SIZE];                        // z - oz, times the weight
    sign_walk splits, signs;
    real low, high;
    int high_positive;  // f at `high`
    int above;          // z > oz between the splits
    int is_last;        // no part follows `high` (a split may round to 1, too)
    radial_root ahead;  // a crossing that is found already, unless `within` is 1
} profile_walk;

FN void next_part(profile_walk* w, axis_ray a) {
    int low_positive = w->high_positive;
    u32 last = w->stride * w->degree;
    w->low = w->high;
    w->above = w->splits.positive;
    w->is_last = !a.flat || !next_sign_change(w->level, w->degree, &w->splits);
    if (!w->is_last) {
        bracket b = start_bracket(w->splits.low, w->splits.high, w->above);
        profile_point c = profile_at(w->p, w->degree, w->stride, b.at);
        int step;
        for (step = 0; step < BRACKET_STEPS && !b.done; ++step) {
            b = newton_step(b, c.z - a.oz, c.dz);
            c = profile_at(w->p, w->degree, w->stride, b.at);
        }
        w->high = b.at;
        w->high_positive = c.r > a.p;
    } else {
        w->high = 1;
        w->high_positive = radial_sign(a, w->f[2 * w->degree], w->p[last], w->p[last + 1]);
    }
    restrict_to(w->f, 2 * w->degree, w->low, w->high, w->part);
    if ((w->part[0] > 0) != low_positive) w->part[0] = low_positive ? FAINT : REAL(0);
    if ((w->part[2 * w->degree] > 0) != w->high_positive) w->part[2 * w->degree] = w->high_positive ? FAINT : REAL(0);
    w->signs = start_sign_walk(w->part);
}

// Starts the walk. 0: the curve has no crossing.
FN int start_profile_walk(profile_walk* w, GLOBAL const real* p, u32 degree, u32 stride, axis_ray a) {
    u32 i, beyond = 0;
    for (i = 0; i <= degree; ++i) {
        beyond += p[stride * i] > a.p;
        w->level[i] = (p[stride * i + 1] - a.oz) * (stride == 3 ? p[stride * i + 2] : REAL(1));
    }
    if (!beyond) return 0;  // the ray passes outside the whole curve
    w->p = p;
    w->degree = degree;
    w->stride = stride;
    radial_form(p, degree, stride, a, w->f);
    if (coefficient_changes(w->f, 2 * degree) == 0 &&
        (!a.flat || (coefficient_changes(w->level, degree) == 0 && w->level[0] != 0 && w->level[degree] != 0)))
        return 0;
    w->splits = start_sign_walk(w->level);
    w->high = 0;
    w->ahead.within = 1;
    w->high_positive = radial_sign(a, w->f[0], p[0], p[1]);
    next_part(w, a);
    return 1;
}

// Moves to the next crossing between two splits. 0: no crossing is left.
FN int next_in_part(profile_walk* w, axis_ray a, radial_root* root) {
    real size = w->high - w->low;
    bracket b;
    if (!next_sign_change(w->part, 2 * w->degree, &w->signs)) return 0;
    b = start_bracket(real_fma(w->signs.low, size, w->low), real_fma(w->signs.high, size, w->low), !w->signs.positive);
    *root = root_of_form(w->p, w->degree, w->stride, a, b, w->above == (a.dz >= 0) ? REAL(1) : REAL(-1));
    return 1;
}

FN int next_profile_crossing(profile_walk* w, axis_ray a, radial_root* root) {
    if (!w->ahead.within) {
        *root = w->ahead;
        w->ahead.within = 1;
        return 1;
    }
    for (;;) {
        // Where f touches 0, as at z = oz if the ray runs across the axis, rounding may make two crossings where there
        // is none: f is negative wherever the curve is nearer to the axis than the ray. Such a pair is left out.
        while (next_in_part(w, a, root))
            if (!root->within || !w->signs.positive || !next_in_part(w, a, &w->ahead) || !w->ahead.within) return 1;
        if (w->is_last) return 0;
        next_part(w, a);
    }
}

#endif
