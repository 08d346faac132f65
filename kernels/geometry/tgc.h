// Truncated general cone: cylinders and cones, right or oblique, circular or elliptical, with one or two different
// tapers. Parameters: affine (12), a0, a1, b0, b1, kind, radius2. Planes: 0 base, 1 top. Surfaces: 0 side, 1 base, 2
// top.
//
//   local z = -1 at the base, +1 at the top (a cone with an apex: 0 at the apex)
//   semi-axes a(z) = a0 + a1 z along x, b(z) = b0 + b1 z along y
//   kind 0 (a = b):  x^2 + y^2 - a^2 < 0                a quadric
//   kind 1:          x^2 b^2 + y^2 a^2 - a^2 b^2 < 0    a quartic
//   radius2: the square of a radius, local, around everything
#ifndef CSGRT_GEOMETRY_TGC_H
#define CSGRT_GEOMETRY_TGC_H

#include "cone.h"
#include "quartic.h"

// The part of `s` within a round cone. A ray steeper than the cone (a < 0) meets both of its nappes, one root on each,
// and m changes sign between them: only the part with m > 0 belongs to the cone.
FN segments cone_inside(local_ray l, quadratic f, real m0, real m1, span s) {
    if (f.a < 0) {
        real u = -m0 / m1;
        if (f.discriminant > 0) {
            real root = real_sqrt(f.discriminant);
            real q = f.b > 0 ? -(f.b + root) : root - f.b;
            real u1 = q / f.a, u2 = f.c / q;
            u = m1 > 0 ? real_max(u1, u2) : real_min(u1, u2);
        }
        u = l.shift + u;
        if (m1 > 0 && u > s.low) {
            s.low = u;
            s.low_surface = TGC_SIDE;
        } else if (m1 < 0 && u < s.high) {
            s.high = u;
            s.high_surface = TGC_SIDE;
        }
        return append(no_segments(), s.low, s.low_surface, s.high, s.high_surface);
    }
    return quadratic_inside(f.a, f.b, f.c, f.discriminant, l.shift, s, TGC_SIDE);
}

// The distance from an edge, in units of the larger semi-axis, below which a ray counts as near. Where a cone ends in
// an edge, or nearly so, the origin of a near ray is moved to its closest approach to the edge. From this origin the
// coefficients vanish with the quartic, so near the edge the quartic has as small a relative error as elsewhere. From
// the usual origin only rounding would be left.
#define EDGE_REACH REAL(0.125)

// The closest approach of the ray, at u, to an edge: the line where a semi-axis m0 + m1 u and the coordinate o + d u
// along this axis are 0.
typedef struct {
    real u, distance2;
} edge_pass;

FN edge_pass edge_pass_of(real o, real d, real m0, real m1, span s) {
    const real rate = real_fma(d, d, m1 * m1);
    edge_pass e;
    real x, m;
    e.u = rate > 0 ? -real_fma(o, d, m0 * m1) / rate : REAL(0);
    e.u = real_max(s.low, real_min(s.high, e.u));
    x = real_fma(e.u, d, o);
    m = real_fma(e.u, m1, m0);
    e.distance2 = real_fma(x, x, m * m);
    return e;
}

// The distance along the unit direction d by which the origin is moved for an edge. `s`: the interval between base and
// top.
NOINLINE_FN real edge_shift(GLOBAL const real* p, vec3 o, vec3 d, span s) {
    const edge_pass a = edge_pass_of(o.x, d.x, real_fma(p[13], o.z, p[12]), p[13] * d.z, s);
    const edge_pass b = edge_pass_of(o.y, d.y, real_fma(p[15], o.z, p[14]), p[15] * d.z, s);
    const real least = real_min(a.distance2, b.distance2);
    if (!(least < EDGE_REACH * EDGE_REACH)) return 0;
    return a.distance2 <= b.distance2 ? a.u : b.u;
}

// The part of `s` with a positive semi-axis m0 + m1 u. The planes of base and top are computed in another way, so a ray
// along an edge could, by rounding, meet the mirrored body beyond the edge.
FN span on_this_side(span s, real m0, real m1) {
    const real u = -m0 / m1;
    if (m1 > 0) s.low = real_max(s.low, u);
    if (m1 < 0) s.high = real_min(s.high, u);
    return s;
}

// Is a semi-axis nearly 0 at base or top?
FN int has_edge(GLOBAL const real* p) {
    return real_min(p[12] - real_abs(p[13]), p[14] - real_abs(p[15])) < EDGE_REACH;
}

// The segments in a tapered cone. The quartic is solved on a bounded interval, with u in units of the direction's
// length.
FN segments tapered_inside(u32 method, GLOBAL const real* p, local_ray l, span s) {
    real length = real_sqrt(dot3(l.d, l.d)), shift = 0;
    real a0, a1, b0, b1;
    vec3 o = l.o;
    quartic g;
    real roots[4];
    int count, i, inside, edge;
    s = tapered_piece(method, p, l, s);
    if (!(s.low < s.high)) return no_segments();
    edge = has_edge(p) && method != QUARTIC_UNSHIFTED;
    if (edge) {
        const vec3 d = scale(l.d, REAL(1) / length);
        shift = edge_shift(p, o, d, s);
        if (shift != 0) {
            o = add_scaled(o, shift, d);
            s.low = s.low - shift;
            s.high = s.high - shift;
        }
    }
    a0 = real_fma(p[13], o.z, p[12]);
    a1 = p[13] * l.d.z;
    b0 = real_fma(p[15], o.z, p[14]);
    b1 = p[15] * l.d.z;
    a1 = a1 / length;
    b1 = b1 / length;
    if (edge) {
        s = on_this_side(on_this_side(s, a0, a1), b0, b1);
        if (!(s.low < s.high)) return no_segments();
    }
    {
        real dx = l.d.x / length, dy = l.d.y / length;
        real x0, x1, x2, y0, y1, y2, z0, z1, z2;
        // x b, y a and a b are quadratics in u
        x0 = o.x * b0;
        x1 = real_fma(o.x, b1, dx * b0);
        x2 = dx * b1;
        y0 = o.y * a0;
        y1 = real_fma(o.y, a1, dy * a0);
        y2 = dy * a1;
        z0 = a0 * b0;
        z1 = real_fma(a0, b1, a1 * b0);
        z2 = a1 * b1;
        g.c[0] = real_fma(x0, x0, y0 * y0) - z0 * z0;
        g.c[1] = REAL(2) * (real_fma(x0, x1, y0 * y1) - z0 * z1);
        g.c[2] = real_fma(x1, x1, y1 * y1) - z1 * z1 + REAL(2) * (real_fma(x0, x2, y0 * y2) - z0 * z2);
        g.c[3] = REAL(2) * (real_fma(x1, x2, y1 * y2) - z1 * z2);
        g.c[4] = real_fma(x2, x2, y2 * y2) - z2 * z2;
    }
    inside = quartic_at(g, s.low) < 0;
    count = quartic_roots(method, g, s.low, s.high, roots);
    for (i = 0; i < count; ++i) roots[i] = l.shift + (shift + roots[i]) / length;
    s.low = l.shift + (shift + s.low) / length;
    s.high = l.shift + (shift + s.high) / length;
    return spans_between(s, inside, roots, count, TGC_SIDE);
}

FN segments tgc_intersect(Geometry g, SolidRecord solid, ray3 r) {
    GLOBAL const real* p = g.reals + solid.first_real;
    span s = between_ends(g, solid, r);
    quadratic f;
    local_ray l;
    real m0, m1;
    if (!(s.low < s.high)) return no_segments();
    if (p[16] != 0) return touching(s.touched, tapered_inside(QUARTIC_OF(g), p, quartic_ray(QUARTIC_OF(g), p, r), s));
    l = to_local(p, r);
    m0 = real_fma(p[13], l.o.z, p[12]);
    m1 = p[13] * l.d.z;
    f = round_side(l, m0, m1);
    return touching(s.touched || may_touch_side(l, f, m0), cone_inside(l, f, m0, m1, s));
}

#endif
