// Torus: local circle of radius 1 in z = 0. Parameters: affine (12), ratio (tube radius / circle radius). Planes: none,
// or those that cut a bend out of it. Surface 0; 1 + i is plane i.
//
//   (|p|^2 - 1 - ratio^2)^2 + 4 (z^2 - ratio^2) < 0
//
// a form whose terms stay small near a thin tube. The quartic along the ray is solved on a piece of it (torus.h), outside which
// it is positive; each root is then polished on (rho - 1)^2 + z^2 - ratio^2, evaluated at the point itself, which has none of
// the expanded form's cancellation.
#ifndef CSGRT_TOR_H
#define CSGRT_TOR_H

#include "quartic.h"
#include "torus.h"

// (rho - 1)^2 + z^2 - ratio^2 at a point, and its rate of change along d.
typedef struct {
    real value, slope;
} tor_form;

FN tor_form tor_at(vec3 o, vec3 d, real u, real ratio) {
    tor_form f;
    vec3 p = add_scaled(o, u, d);
    real rho = real_sqrt(real_fma(p.x, p.x, p.y * p.y));
    real radial = rho - REAL(1);
    f.value = difference_of_products(radial, radial, ratio - p.z, ratio + p.z);
    f.slope = REAL(2) * real_fma(radial, real_fma(p.x, d.x, p.y * d.y) / rho, p.z * d.z);
    return f;
}

// Newton from a root of the quartic, whose error is at most about a tenth of POLISH_STEP (a grazed thin tube, a pinched one). A step
// is taken if it is small and brings the point nearer to the surface.
FN real tor_polish(vec3 o, vec3 d, real u, real ratio) {
    tor_form f = tor_at(o, d, u, ratio);
    int step;
    for (step = 0; step < 2; ++step) {
        real next = u - f.value / f.slope;
        tor_form g;
        if (!(real_abs(next - u) < POLISH_STEP)) return u;
        g = tor_at(o, d, next, ratio);
        if (!(real_abs(g.value) < real_abs(f.value))) return u;
        u = next;
        f = g;
    }
    return u;
}

FN hits tor_pieces(u32 method, GLOBAL const real* p, ray3 r) {
    const tor_piece piece = tor_piece_of(method, p, r);
    const vec3 o = piece.l.o, d = piece.d;
    const real ratio = p[12], beta = dot3(o, d), omega = dot3(o, o);
    real m;
    quartic g;
    real roots[4];
    int count, i;
    if (!(piece.low < piece.high)) return no_hits();
    m = omega - REAL(1) - ratio * ratio;
    g.c[4] = 1;
    g.c[3] = REAL(4) * beta;
    g.c[2] = real_fma(REAL(4) * beta, beta, REAL(2) * m) + REAL(4) * d.z * d.z;
    g.c[1] = REAL(4) * real_fma(beta, m, REAL(2) * o.z * d.z);
    g.c[0] = real_fma(m, m, REAL(4) * (o.z - ratio) * (o.z + ratio));
    count = quartic_roots(method, g, piece.low, piece.high, roots);
    for (i = 0; i < count; ++i) {
        roots[i] = piece.l.shift + tor_polish(o, d, roots[i], ratio) / piece.length;
        if (i > 0 && roots[i] < roots[i - 1]) roots[i] = roots[i - 1];  // polishing never changes the order
    }
    return spans_between(whole_line(), 0, roots, count & ~1, 0);
}

FN hits append_within(hits h, span s, real in, u32 in_surface, real out, u32 out_surface) {
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

FN hits tor_intersect(Geometry g, SolidRecord solid, ray3 r) {
    const span s = tor_bend(g, solid, r);
    hits all, h = no_hits();
    if (!(s.low < s.high)) return h;
    all = tor_pieces(QUARTIC_OF(g), g.reals + solid.first_real, r);
    if (solid.plane_count == 0) return all;
    if (all.count > 0) h = append_within(h, s, all.in0, all.in0_surface, all.out0, all.out0_surface);
    if (all.count > 1) h = append_within(h, s, all.in1, all.in1_surface, all.out1, all.out1_surface);
    return mark(h, s.missed);
}

#endif
