// Torus: local circle of radius 1 in z = 0. Parameters: affine (12), ratio (tube radius / circle radius). Planes: none,
// or the planes that cut a bend out of the torus. Surface 0; 1 + i is plane i.
//
//   (|p|^2 - 1 - ratio^2)^2 + 4 (z^2 - ratio^2) < 0
//
// The terms of this form stay small near a thin tube. The quartic along the ray is solved on an interval (torus.h)
// outside which it is positive. Each root is then polished on (rho - 1)^2 + z^2 - ratio^2, evaluated at the point
// itself, which avoids the cancellation of the expanded form.
//
// Where the hole is nearly closed, the surface comes near the centre, and there only rounding is left of these terms.
// With gap = 1 - ratio^2 the same two functions, the quartic and the form for polishing, are
//
//   (|p|^2 + gap)^2 - 4 rho^2        |p|^2 + gap - 2 rho
//
// Their terms vanish with f at the pinch of a horn torus. The origin is the ray's closest approach to this very point,
// so the coefficients along the ray vanish, too. Near the pinch the quartic therefore has as small a relative error as
// elsewhere.
#ifndef CSGRT_GEOMETRY_TOR_H
#define CSGRT_GEOMETRY_TOR_H

#include "quartic.h"
#include "torus.h"

// The limits of the pinch: a ray passes the centre within PINCH_REACH, and the hole of the torus has a radius below 1 -
// PINCH_RATIO. Other rays meet the surface where the usual terms of the quartic cancel by a digit or two at most.
#define PINCH_REACH REAL(0.2)
#define PINCH_RATIO REAL(0.75)

// The value of (rho - 1)^2 + z^2 - ratio^2 at a point, and its rate of change along d.
typedef struct {
    real value, slope;
} tor_form;

FN tor_form tor_at(vec3 o, vec3 d, real u, real ratio, int pinched) {
    tor_form f;
    vec3 p = add_scaled(o, u, d);
    real across = real_fma(p.x, p.x, p.y * p.y);
    real rho = real_sqrt(across);
    real radial = rho - REAL(1);
    if (pinched)
        f.value = (across + real_fma(p.z, p.z, (REAL(1) - ratio) * (REAL(1) + ratio))) - REAL(2) * rho;
    else
        f.value = difference_of_products(radial, radial, ratio - p.z, ratio + p.z);
    f.slope = REAL(2) * real_fma(radial, real_fma(p.x, d.x, p.y * d.y) / rho, p.z * d.z);
    return f;
}

// Newton's steps from a root of the quartic, whose error is at most about a tenth of POLISH_STEP (a grazed thin tube).
// A step is taken if it is small and brings the point nearer to the surface.
FN real tor_polish(vec3 o, vec3 d, real u, real ratio, int pinched) {
    tor_form f = tor_at(o, d, u, ratio, pinched);
    int step;
    for (step = 0; step < 2; ++step) {
        real next = u - f.value / f.slope;
        tor_form g;
        if (!(real_abs(next - u) < POLISH_STEP)) return u;
        g = tor_at(o, d, next, ratio, pinched);
        if (!(real_abs(g.value) < real_abs(f.value))) return u;
        u = next;
        f = g;
    }
    return u;
}

// Is the segment so short that the ray may only touch the torus there?
FN int is_short(real in, real out, real length) { return (out - in) * length < REAL(0x1p-6); }

FN segments tor_pieces(u32 method, GLOBAL const real* p, ray3 r) {
    const tor_piece piece = tor_piece_of(method, p, r);
    const vec3 o = piece.l.o, d = piece.d;
    const real ratio = p[12], beta = dot3(o, d), omega = dot3(o, o);
    real m;
    quartic g;
    real roots[4];
    int count, i, pinched;
    segments h;
    if (!(piece.low < piece.high)) return no_segments();
    pinched = ratio > PINCH_RATIO && omega < PINCH_REACH * PINCH_REACH;
    m = omega - REAL(1) - ratio * ratio;
    g.c[4] = 1;
    g.c[3] = REAL(4) * beta;
    g.c[2] = real_fma(REAL(4) * beta, beta, REAL(2) * m) + REAL(4) * d.z * d.z;
    g.c[1] = REAL(4) * real_fma(beta, m, REAL(2) * o.z * d.z);
    g.c[0] = real_fma(m, m, REAL(4) * (o.z - ratio) * (o.z + ratio));
    if (pinched) {
        const real rho = real_sqrt(real_fma(o.x, o.x, o.y * o.y));
        m = real_fma(REAL(1) - ratio, REAL(1) + ratio, omega);
        g.c[2] = real_fma(REAL(4) * beta, beta, REAL(2) * m) - REAL(4) * real_fma(d.x, d.x, d.y * d.y);
        g.c[1] = REAL(4) * difference_of_products(beta, m, REAL(2), real_fma(o.x, d.x, o.y * d.y));
        g.c[0] = (m - REAL(2) * rho) * (m + REAL(2) * rho);
    }
    count = quartic_roots(method, g, piece.low, piece.high, roots);
    for (i = 0; i < count; ++i) {
        roots[i] = piece.l.shift + tor_polish(o, d, roots[i], ratio, pinched) / piece.length;
        if (i > 0 && roots[i] < roots[i - 1]) roots[i] = roots[i - 1];  // polishing never changes the order
    }
    h = spans_between(whole_line(), 0, roots, count & ~1, 0);
    return touching(is_short(h.in0, h.out0, piece.length) || (h.count > 1 && is_short(h.in1, h.out1, piece.length)), h);
}

FN segments append_within(segments h, span s, real in, u32 in_surface, real out, u32 out_surface) {
    if (s.low > in) {
        in = s.low;
        in_surface = s.low_surface;
    }
    if (s.high < out) {
        out = s.high;
        out_surface = s.high_surface;
    }
    return append(h, in, in_surface, out, out_surface);
}

FN segments tor_intersect(Geometry g, SolidRecord solid, ray3 r) {
    const span s = tor_bend(g, solid, r);
    segments all, h = no_segments();
    if (!(s.low < s.high)) return h;
    all = tor_pieces(QUARTIC_OF(g), g.reals + solid.first_real, r);
    if (solid.plane_count == 0) return all;
    if (all.count > 0) h = append_within(h, s, all.in0, all.in0_surface, all.out0, all.out0_surface);
    if (all.count > 1) h = append_within(h, s, all.in1, all.in1_surface, all.out1, all.out1_surface);
    return touching(s.touched || all.touched, h);
}

#endif
