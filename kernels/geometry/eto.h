// Elliptical torus: an ellipse turned about the local z axis, its centre on the circle of radius 1 in z = 0.
// Parameters: affine (12), alpha, beta, gamma, half height, outer radius. Surface 0.
//
//   F(rho) = alpha (rho - 1)^2 + 2 beta (rho - 1) z + gamma z^2 - 1 < 0
//
// F(rho) F(-rho) is a quartic along the ray, and F(-rho) > 0 as long as the ellipse stays on its side of the axis. Written
// in R = rho^2 - 1 and G = gamma z^2 - 1 its terms stay small near a thin tube. Each root is polished on F itself.
#ifndef CSGRT_ETO_H
#define CSGRT_ETO_H

#include "affine.h"
#include "quartic.h"

#define ETO_MARGIN REAL(1.000001)  // the piece that is searched is a little larger than the solid, so its ends are outside

// F at a point, and its rate of change along d.
typedef struct {
    real value, slope;
} eto_form;

FN eto_form eto_at(GLOBAL const real* p, vec3 o, vec3 d, real u) {
    eto_form f;
    vec3 at = add_scaled(o, u, d);
    real rho = real_sqrt(real_fma(at.x, at.x, at.y * at.y));
    real radial = rho - REAL(1);
    real rate = real_fma(at.x, d.x, at.y * d.y) / rho;
    real by_radial = real_fma(p[12], radial, p[13] * at.z), by_z = real_fma(p[13], radial, p[14] * at.z);
    f.value = real_fma(by_radial, radial, by_z * at.z) - REAL(1);
    f.slope = REAL(2) * real_fma(by_radial, rate, by_z * d.z);
    return f;
}

// Newton from a root of the quartic, whose error is at most about 1e-7 (a grazed thin tube, a pinched one). A step is taken
// if it is small and brings the point nearer to the surface.
FN real eto_polish(GLOBAL const real* p, vec3 o, vec3 d, real u) {
    eto_form f = eto_at(p, o, d, u);
    int step;
    for (step = 0; step < 2; ++step) {
        real next = u - f.value / f.slope;
        eto_form g;
        if (!(real_abs(next - u) < REAL(1e-6))) return u;
        g = eto_at(p, o, d, next);
        if (!(real_abs(g.value) < real_abs(f.value))) return u;
        u = next;
        f = g;
    }
    return u;
}

FN hits eto_intersect(Geometry tables, SolidRecord solid, ray3 r) {
    GLOBAL const real* p = tables.reals + solid.first_real;
    u32 method = QUARTIC_OF(tables);
    local_ray l = quartic_ray(method, p, r);
    real alpha = p[12], beta = p[13], gamma = p[14];
    real height = p[15] * ETO_MARGIN, outer = p[16] * ETO_MARGIN;
    real length = real_sqrt(dot3(l.d, l.d));
    vec3 d = scale(l.d, REAL(1) / length);
    real middle = quartic_middle(method, l.o, d);
    real reach2 = real_fma(outer, outer, height * height) - (dot3(l.o, l.o) - middle * middle);
    span s = whole_line();
    real low, high;
    quartic g;
    real roots[4];
    int count, i;
    if (!(reach2 > 0)) return no_hits();
    high = real_sqrt(reach2) * ETO_MARGIN;
    low = middle - high;
    high = middle + high;
    if (d.z != 0) {
        real z0 = (-height - l.o.z) / d.z, z1 = (height - l.o.z) / d.z;
        low = real_max(low, real_min(z0, z1));
        high = real_min(high, real_max(z0, z1));
    } else if (real_abs(l.o.z) > height) {
        return no_hits();
    }
    if (!(low < high)) return no_hits();
    {
        // R = rho^2 - 1 = r0 + r1 u + r2 u^2, z = z0 + z1 u, G = gamma z^2 - 1 = g0 + g1 u + g2 u^2
        real r0 = real_fma(l.o.x, l.o.x, l.o.y * l.o.y) - REAL(1);
        real r1 = REAL(2) * real_fma(l.o.x, d.x, l.o.y * d.y);
        real r2 = real_fma(d.x, d.x, d.y * d.y);
        real z0 = l.o.z, z1 = d.z;
        real g0 = real_fma(gamma * z0, z0, REAL(-1)), g1 = REAL(2) * gamma * z0 * z1, g2 = gamma * z1 * z1;
        // The product is alpha R (alpha R + 2 G + 4 beta z) + G (G + 4 (alpha - beta z)) - 4 (beta z)^2 R.
        real b0 = beta * z0, b1 = beta * z1;
        real a0 = alpha * r0, a1 = alpha * r1, a2 = alpha * r2;
        real s0 = real_fma(REAL(4), b0, real_fma(REAL(2), g0, a0)), s1 = real_fma(REAL(4), b1, real_fma(REAL(2), g1, a1));
        real s2 = real_fma(REAL(2), g2, a2);
        real t0 = real_fma(REAL(4), alpha - b0, g0), t1 = real_fma(REAL(-4), b1, g1);
        real q0 = REAL(4) * b0 * b0, q1 = REAL(8) * b0 * b1, q2 = REAL(4) * b1 * b1;
        g.c[0] = real_fma(a0, s0, g0 * t0) - q0 * r0;
        g.c[1] = real_fma(a0, s1, a1 * s0) + real_fma(g0, t1, g1 * t0) - real_fma(q0, r1, q1 * r0);
        g.c[2] = real_fma(a0, s2, real_fma(a1, s1, a2 * s0)) + real_fma(g0, g2, real_fma(g1, t1, g2 * t0)) -
                 real_fma(q0, r2, real_fma(q1, r1, q2 * r0));
        g.c[3] = real_fma(a1, s2, a2 * s1) + real_fma(g1, g2, g2 * t1) - real_fma(q1, r2, q2 * r1);
        g.c[4] = real_fma(a2, s2, g2 * g2) - q2 * r2;
    }
    count = quartic_roots(method, g, low, high, roots);
    for (i = 0; i < count; ++i) {
        roots[i] = l.shift + eto_polish(p, l.o, d, roots[i]) / length;
        if (i > 0 && roots[i] < roots[i - 1]) roots[i] = roots[i - 1];  // polishing never changes the order
    }
    return spans_between(s, 0, roots, count & ~1, 0);
}

FN vec3 eto_normal(GLOBAL const real* p, ray3 r, real t) {
    vec3 at = local_point(to_local(p, r), t);
    real rho = real_sqrt(real_fma(at.x, at.x, at.y * at.y));
    real radial = rho - REAL(1);
    real by_radial = real_fma(p[12], radial, p[13] * at.z) / rho;
    return affine_normal(p, make_vec3(at.x * by_radial, at.y * by_radial, real_fma(p[13], radial, p[14] * at.z)));
}

#endif
