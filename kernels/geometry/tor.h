// Torus: local circle of radius 1 in z = 0. Parameters: affine (12), ratio (tube radius / circle radius). Planes: none,
// or those that cut a bend out of it. Surface 0; 1 + i is plane i.
//
//   (|p|^2 - 1 - ratio^2)^2 + 4 (z^2 - ratio^2) < 0
//
// a form whose terms stay small near a thin tube. The quartic along the ray is solved on the piece inside the slab
// |z| <= ratio and the sphere |p| <= 1 + ratio (outside them it is positive); each root is then polished on
// (rho - 1)^2 + z^2 - ratio^2, evaluated at the point itself, which has none of the expanded form's cancellation.
#ifndef CSGRT_TOR_H
#define CSGRT_TOR_H

#include "affine.h"
#include "plane.h"
#include "quartic.h"

#define TOR_MARGIN BY_PRECISION(1.0001, 1.000001, 1.000001)  // the piece is a little larger than the torus, so that its ends are outside

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

FN real axis_distance2(vec3 o, vec3 d, real u) {
    real x = real_fma(u, d.x, o.x), y = real_fma(u, d.y, o.y);
    return real_fma(x, x, y * y);
}

FN hits tor_pieces(u32 method, GLOBAL const real* p, ray3 r) {
    local_ray l = quartic_ray(method, p, r);
    real ratio = p[12];
    real outer = (REAL(1) + ratio) * TOR_MARGIN;
    real tube = ratio * TOR_MARGIN;
    real inner = (REAL(1) - ratio) * (REAL(2) - TOR_MARGIN);
    real length = real_sqrt(dot3(l.d, l.d));
    vec3 d = scale(l.d, REAL(1) / length);
    real beta = dot3(l.o, d);
    real omega = dot3(l.o, l.o);
    real middle = quartic_middle(method, l.o, d);
    real reach2 = outer * outer - (omega - middle * middle);
    span s = whole_line();
    real m, low, high;
    quartic g;
    real roots[4];
    int count, i;
    if (!(reach2 > 0)) return no_hits();
    high = real_sqrt(reach2) * TOR_MARGIN;
    low = middle - high;
    high = middle + high;
    if (d.z != 0) {
        real z0 = (-tube - l.o.z) / d.z, z1 = (tube - l.o.z) / d.z;
        low = real_max(low, real_min(z0, z1));
        high = real_min(high, real_max(z0, z1));
    } else if (real_abs(l.o.z) > ratio) {
        return no_hits();
    }
    if (!(low < high)) return no_hits();
    // Most rays through the box of a thin ring pass within it. The distance from the axis is greatest at an end of the piece.
    if (ratio < REAL(1) && real_max(axis_distance2(l.o, d, low), axis_distance2(l.o, d, high)) < inner * inner) return no_hits();
    m = omega - REAL(1) - ratio * ratio;
    g.c[4] = 1;
    g.c[3] = REAL(4) * beta;
    g.c[2] = real_fma(REAL(4) * beta, beta, REAL(2) * m) + REAL(4) * d.z * d.z;
    g.c[1] = REAL(4) * real_fma(beta, m, REAL(2) * l.o.z * d.z);
    g.c[0] = real_fma(m, m, REAL(4) * (l.o.z - ratio) * (l.o.z + ratio));
    count = quartic_roots(method, g, low, high, roots);
    for (i = 0; i < count; ++i) {
        roots[i] = l.shift + tor_polish(l.o, d, roots[i], ratio) / length;
        if (i > 0 && roots[i] < roots[i - 1]) roots[i] = roots[i - 1];  // polishing never changes the order
    }
    return spans_between(s, 0, roots, count & ~1, 0);
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
    span s = whole_line();
    hits all, h = no_hits();
    u32 i;
    for (i = 0; i < solid.plane_count; ++i) s = clip_to_face(s, g, solid.first_plane + i, r, 1 + i);
    if (!(s.low < s.high)) return h;
    all = tor_pieces(QUARTIC_OF(g), g.reals + solid.first_real, r);
    if (solid.plane_count == 0) return all;
    if (all.count > 0) h = append_within(h, s, all.in0, all.in0_surface, all.out0, all.out0_surface);
    if (all.count > 1) h = append_within(h, s, all.in1, all.in1_surface, all.out1, all.out1_surface);
    return h;
}

FN vec3 tor_normal(Geometry g, SolidRecord solid, ray3 r, real t, u32 surface) {
    GLOBAL const real* p = g.reals + solid.first_real;
    vec3 at;
    real rho, radial;
    if (surface != 0) return face_normal(g, solid.first_plane + surface - 1);
    at = local_point(to_local(p, r), t);
    rho = real_sqrt(real_fma(at.x, at.x, at.y * at.y));
    radial = (rho - REAL(1)) / rho;
    return affine_normal(p, make_vec3(at.x * radial, at.y * radial, at.z));
}

#endif
