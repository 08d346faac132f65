// Elliptical torus: an ellipse turned about the local z axis, its centre on the circle of radius 1 in z = 0.
// Parameters: affine (12), alpha, beta, gamma, half height, outer radius. Surface 0.
//
//   F(rho) = alpha (rho - 1)^2 + 2 beta (rho - 1) z + gamma z^2 - 1 < 0
//
// F(rho) F(-rho) is a quartic along the ray. F(-rho) > 0 as long as the ellipse stays on its side of the axis (else:
// crossed_eto.h). Written in R = rho^2 - 1 and G = gamma z^2 - 1, the quartic has small terms near a thin tube. Each
// root is polished on F itself.
//
// Where the ellipse nearly touches the axis, at z = beta / gamma, only rounding is left of these terms. With h the
// height above this point, reach = outer radius - 1 and gap = 1 / reach^2 - 1, F has another form:
//
//   F(rho) = E + rho O,   F(rho) F(-rho) = E^2 - rho^2 O^2
//   E = alpha rho^2 + gamma h^2 + gap,   O = 2 beta h - 2 (1 + gap)
//
// The terms of this form vanish with F where the gap is 0. The origin of a ray that passes near is its closest approach
// to the point.
#ifndef CSGRT_GEOMETRY_ETO_H
#define CSGRT_GEOMETRY_ETO_H

#include "affine.h"
#include "quartic.h"

#define ETO_MARGIN                 \
    BY_PRECISION(1.0001, 1.000001, \
                 1.000001)  // the searched interval is a little larger than the solid, so both its limits are outside

// The value of F at a point, and its rate of change along d.
typedef struct {
    real value, slope;
} eto_form;

// The pinch, the point where the ellipse is nearest to the axis, relative to a ray that passes it (tor.h).
typedef struct {
    vec3 o;      // the ray's closest approach, relative to the pinch
    real along;  // the distance of the closest approach along the ray
    real gap;
    int passes;  // whether the ray passes near the pinch
} eto_pinch;

#define ETO_PINCH_REACH REAL(0.2)
#define ETO_PINCH_OUTER REAL(1.75)  // the least outer radius

FN eto_pinch eto_pinch_of(GLOBAL const real* p, u32 method, vec3 o, vec3 d) {
    eto_pinch pinch;
    pinch.passes = 0;
    pinch.along = pinch.gap = 0;
    pinch.o = o;
    if (p[16] > ETO_PINCH_OUTER && method != QUARTIC_UNSHIFTED) {
        const real reach = p[16] - REAL(1);
        pinch.o.z = o.z - p[13] / p[14];
        pinch.along = -dot3(pinch.o, d);
        pinch.o = add_scaled(pinch.o, pinch.along, d);
        // By rounding, an ellipse that touches the axis may cross it.
        pinch.gap = real_max(REAL(0), (REAL(2) - p[16]) * p[16] / (reach * reach));
        pinch.passes = dot3(pinch.o, pinch.o) < ETO_PINCH_REACH * ETO_PINCH_REACH;
    }
    return pinch;
}

FN eto_form eto_at(GLOBAL const real* p, vec3 o, vec3 d, real u, eto_pinch pinch) {
    eto_form f;
    vec3 at = add_scaled(pinch.passes ? pinch.o : o, u, d);
    real across = real_fma(at.x, at.x, at.y * at.y), rho = real_sqrt(across);
    real turn = real_fma(at.x, d.x, at.y * d.y);
    if (pinch.passes) {
        real odd = REAL(2) * (p[13] * at.z - (REAL(1) + pinch.gap));
        f.value = real_fma(p[12], across, real_fma(p[14] * at.z, at.z, pinch.gap)) + rho * odd;
        f.slope = REAL(2) * real_fma(p[12], turn, real_fma(p[14] * at.z, d.z, rho * (p[13] * d.z))) + turn / rho * odd;
    } else {
        real radial = rho - REAL(1);
        real rate = turn / rho;
        real by_radial = real_fma(p[12], radial, p[13] * at.z), by_z = real_fma(p[13], radial, p[14] * at.z);
        f.value = real_fma(by_radial, radial, by_z * at.z) - REAL(1);
        f.slope = REAL(2) * real_fma(by_radial, rate, by_z * d.z);
    }
    return f;
}

// Newton's steps from a root of the quartic, whose error is at most about a tenth of POLISH_STEP (a grazed thin tube).
// A step is taken if it is small and brings the point nearer to the surface.
FN real eto_polish(GLOBAL const real* p, vec3 o, vec3 d, real u, eto_pinch pinch) {
    eto_form f = eto_at(p, o, d, u, pinch);
    int step;
    for (step = 0; step < 2; ++step) {
        real next = u - f.value / f.slope;
        eto_form g;
        if (!(real_abs(next - u) < POLISH_STEP)) return u;
        g = eto_at(p, o, d, next, pinch);
        if (!(real_abs(g.value) < real_abs(f.value))) return u;
        u = next;
        f = g;
    }
    return u;
}

// The quartic E^2 - rho^2 O^2 along a ray, from E = e0 + e1 u + e2 u^2, O = q0 + q1 u and rho^2 = r0 + r1 u + r2 u^2.
FN quartic eto_product(real e0, real e1, real e2, real q0, real q1, real r0, real r1, real r2) {
    // O^2 = s0 + s1 u + s2 u^2
    const real s0 = q0 * q0, s1 = REAL(2) * q0 * q1, s2 = q1 * q1, reached = real_sqrt(r0) * q0;
    quartic g;
    g.c[0] = (e0 - reached) * (e0 + reached);
    g.c[1] = REAL(2) * e0 * e1 - real_fma(r0, s1, r1 * s0);
    g.c[2] = real_fma(e1, e1, REAL(2) * e0 * e2) - real_fma(r0, s2, real_fma(r1, s1, r2 * s0));
    g.c[3] = REAL(2) * e1 * e2 - real_fma(r1, s2, r2 * s1);
    g.c[4] = real_fma(e2, e2, -r2 * s2);
    return g;
}

FN quartic eto_pinched(GLOBAL const real* p, eto_pinch pinch, vec3 d) {
    const vec3 o = pinch.o;
    const real r0 = real_fma(o.x, o.x, o.y * o.y), r1 = REAL(2) * real_fma(o.x, d.x, o.y * d.y);
    const real r2 = real_fma(d.x, d.x, d.y * d.y);
    const real e0 = real_fma(p[12], r0, real_fma(p[14] * o.z, o.z, pinch.gap));
    const real e1 = real_fma(p[12], r1, REAL(2) * p[14] * o.z * d.z), e2 = real_fma(p[12], r2, p[14] * d.z * d.z);
    const real q0 = REAL(2) * (p[13] * o.z - (REAL(1) + pinch.gap)), q1 = REAL(2) * p[13] * d.z;
    return eto_product(e0, e1, e2, q0, q1, r0, r1, r2);
}

// The quartic of a ray that does not pass near the pinch.
FN quartic eto_quartic(GLOBAL const real* p, vec3 o, vec3 d) {
    const real alpha = p[12], beta = p[13], gamma = p[14];
    quartic g;
    // R = rho^2 - 1 = r0 + r1 u + r2 u^2, z = z0 + z1 u, G = gamma z^2 - 1 = g0 + g1 u + g2 u^2
    real r0 = real_fma(o.x, o.x, o.y * o.y) - REAL(1);
    real r1 = REAL(2) * real_fma(o.x, d.x, o.y * d.y);
    real r2 = real_fma(d.x, d.x, d.y * d.y);
    real z0 = o.z, z1 = d.z;
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
    return g;
}

// The interval of a ray that may meet the solid, between `low` and `high` along the unit direction d. Empty: low >=
// high.
typedef struct {
    local_ray l;
    vec3 d;
    real length;  // of l.d
    real low, high;
} eto_piece;

FN eto_piece eto_piece_of(GLOBAL const real* p, u32 method, ray3 r) {
    const real height = p[15] * ETO_MARGIN, outer = p[16] * ETO_MARGIN;
    real middle, reach2;
    eto_piece s;
    s.l = quartic_ray(method, p, r);
    s.length = real_sqrt(dot3(s.l.d, s.l.d));
    s.d = scale(s.l.d, REAL(1) / s.length);
    middle = quartic_middle(method, s.l.o, s.d);
    reach2 = real_fma(outer, outer, height * height) - (dot3(s.l.o, s.l.o) - middle * middle);
    s.low = s.high = 0;
    if (!(reach2 > 0)) return s;
    s.high = real_sqrt(reach2) * ETO_MARGIN;
    s.low = middle - s.high;
    s.high = middle + s.high;
    if (s.d.z != 0) {
        const real z0 = (-height - s.l.o.z) / s.d.z, z1 = (height - s.l.o.z) / s.d.z;
        s.low = real_max(s.low, real_min(z0, z1));
        s.high = real_min(s.high, real_max(z0, z1));
    } else if (real_abs(s.l.o.z) > height) {
        s.high = s.low;
    }
    return s;
}

FN segments eto_intersect(Geometry tables, SolidRecord solid, ray3 r) {
    GLOBAL const real* p = tables.reals + solid.first_real;
    const u32 method = QUARTIC_OF(tables);
    const eto_piece s = eto_piece_of(p, method, r);
    const vec3 d = s.d;
    real low = s.low, high = s.high;
    quartic g;
    real roots[4];
    int count, i;
    eto_pinch pinch;
    if (!(low < high)) return no_segments();
    pinch = eto_pinch_of(p, method, s.l.o, d);
    if (pinch.passes) {
        g = eto_pinched(p, pinch, d);
        low = low - pinch.along;
        high = high - pinch.along;
    } else {
        g = eto_quartic(p, s.l.o, d);
    }
    count = quartic_roots(method, g, low, high, roots);
    for (i = 0; i < count; ++i) {
        real u = eto_polish(p, s.l.o, d, roots[i], pinch);
        roots[i] = s.l.shift + (pinch.passes ? u + pinch.along : u) / s.length;
        if (i > 0 && roots[i] < roots[i - 1]) roots[i] = roots[i - 1];  // polishing never changes the order
    }
    return spans_between(whole_line(), 0, roots, count & ~1, 0);
}

FN vec3 eto_normal(GLOBAL const real* p, ray3 r, real t) {
    vec3 at = local_point(to_local(p, r), t);
    real rho = real_sqrt(real_fma(at.x, at.x, at.y * at.y));
    real radial = rho - REAL(1);
    real by_radial = real_fma(p[12], radial, p[13] * at.z) / rho;
    return affine_normal(p, make_vec3(at.x * by_radial, at.y * by_radial, real_fma(p[13], radial, p[14] * at.z)));
}

#endif
