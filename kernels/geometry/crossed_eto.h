// Crossed eto: an elliptical torus whose ellipse crosses the axis, as in BRL-CAD. A point is inside where F(rho)
// F(-rho) < 0 (eto.h): in exactly one of the ellipse and its mirror image. The points in both, a lens about the axis,
// are outside. The product is still a quartic along the ray: at most two segments. Surface 0. Parameters: the eto's
// (17), then for each of three pivots its height on the axis, lin, odd and radius.
//
// The two factors vanish together at the two points of the lens on the axis. They also vanish on a circle where the
// ellipse and its image cross once more, if the top of the ellipse has passed the axis. There the product has no usable
// surface: a ray that passes near has two roots whose difference is about its distance. So near each of these pivots
// (the two points and the circle) F is written in another form. With h the height above the pivot,
//
//   F(rho) = E + rho O,   E = alpha (rho^2 - radius^2) + gamma h^2 + lin h,   O = 2 beta h + odd
//
// (radius 0 at the axis, odd 0 on the circle). The terms of this form vanish at the pivot as F does. The ray is divided
// between pivots.
#ifndef CSGRT_GEOMETRY_CROSSED_ETO_H
#define CSGRT_GEOMETRY_CROSSED_ETO_H

#include "eto.h"

#define CROSSED_FIRST 17             // the parameters of the first pivot
#define CROSSED_PIVOTS 3             // two points, one circle
#define CROSSED_PLACES 4             // positions on a ray: it may pass the circle twice
#define CROSSED_NONE REAL(-1)        // radius, where there is no circle
#define CROSSED_APART REAL(0x1p-10)  // closer positions on a ray count as one
#define CROSSED_STEPS 6

// A position on a ray near a pivot; or the ray's origin, where F has the form of an ordinary eto.
typedef struct {
    vec3 o;      // the ray's point, relative to the axis at the pivot's height
    real along;  // the point's distance along the ray
    real lin, odd, radius;
    int plain;
} crossed_place;

FN crossed_place crossed_plain(vec3 o) {
    crossed_place place;
    place.o = o;
    place.along = place.lin = place.odd = place.radius = 0;
    place.plain = 1;
    return place;
}

FN crossed_place crossed_at(GLOBAL const real* pivot, vec3 o, vec3 d, real along) {
    crossed_place place;
    o.z = o.z - pivot[0];
    place.o = add_scaled(o, along, d);
    place.along = along;
    place.lin = pivot[1];
    place.odd = pivot[2];
    place.radius = pivot[3];
    place.plain = 0;
    return place;
}

FN quartic crossed_quartic(GLOBAL const real* p, crossed_place place, vec3 d) {
    const vec3 o = place.o;
    const real r0 = real_fma(o.x, o.x, o.y * o.y), r1 = REAL(2) * real_fma(o.x, d.x, o.y * d.y);
    const real r2 = real_fma(d.x, d.x, d.y * d.y), rho = real_sqrt(r0);
    const real across = (rho - place.radius) * (rho + place.radius);
    const real e0 = real_fma(p[12], across, real_fma(p[14], o.z, place.lin) * o.z);
    const real e1 = real_fma(p[12], r1, real_fma(REAL(2) * p[14], o.z, place.lin) * d.z);
    const real e2 = real_fma(p[12], r2, p[14] * d.z * d.z);
    const real q0 = real_fma(REAL(2) * p[13], o.z, place.odd), q1 = REAL(2) * p[13] * d.z;
    if (place.plain) return eto_quartic(p, o, d);
    return eto_product(e0, e1, e2, q0, q1, r0, r1, r2);
}

// F(side rho), side 1 or -1.
FN eto_form crossed_form(GLOBAL const real* p, crossed_place place, vec3 d, real u, real side) {
    const vec3 at = add_scaled(place.o, u, d);
    const real across = real_fma(at.x, at.x, at.y * at.y), rho = real_sqrt(across);
    const real turn = real_fma(at.x, d.x, at.y * d.y), rate = side * (turn / rho);
    eto_form f;
    if (place.plain) {
        const real radial = side * rho - REAL(1);
        const real by_radial = real_fma(p[12], radial, p[13] * at.z), by_z = real_fma(p[13], radial, p[14] * at.z);
        f.value = real_fma(by_radial, radial, by_z * at.z) - REAL(1);
        f.slope = REAL(2) * real_fma(by_radial, rate, by_z * d.z);
    } else {
        const real odd = real_fma(REAL(2) * p[13], at.z, place.odd);
        const real even =
            real_fma(p[12], (rho - place.radius) * (rho + place.radius), real_fma(p[14], at.z, place.lin) * at.z);
        f.value = real_fma(side * rho, odd, even);
        f.slope = real_fma(rate, odd, side * rho * (REAL(2) * p[13] * d.z)) +
                  real_fma(REAL(2) * p[12], turn, real_fma(REAL(2) * p[14], at.z, place.lin) * d.z);
    }
    return f;
}

// Polishes a root, as eto_polish does, on the factor that vanishes.
FN real crossed_polish(GLOBAL const real* p, crossed_place place, vec3 d, real u) {
    eto_form f = crossed_form(p, place, d, u, REAL(1));
    const eto_form image = crossed_form(p, place, d, u, REAL(-1));
    real side = 1;
    int step;
    if (real_abs(image.value) < real_abs(f.value)) {
        side = -1;
        f = image;
    }
    for (step = 0; step < 2; ++step) {
        const real next = u - f.value / f.slope;
        eto_form g;
        if (!(real_abs(next - u) < POLISH_STEP)) return u;
        g = crossed_form(p, place, d, next, side);
        if (!(real_abs(g.value) < real_abs(f.value))) return u;
        u = next;
        f = g;
    }
    return u;
}

// The closest approach of the ray to a circle about the axis, from a position near it: alternating projections.
FN real crossed_closest(GLOBAL const real* pivot, vec3 o, vec3 d, real u) {
    int step;
    o.z = o.z - pivot[0];
    for (step = 0; step < CROSSED_STEPS; ++step) {
        const vec3 at = add_scaled(o, u, d);
        const real rho = real_sqrt(real_fma(at.x, at.x, at.y * at.y));
        const real share = rho > 0 ? pivot[3] / rho : REAL(0);
        u = dot3(make_vec3(at.x * share - o.x, at.y * share - o.y, -o.z), d);
    }
    return u;
}

FN int crossed_is_near(crossed_place place) {
    const real off = real_sqrt(real_fma(place.o.x, place.o.x, place.o.y * place.o.y)) - place.radius;
    return real_fma(off, off, place.o.z * place.o.z) < ETO_PINCH_REACH * ETO_PINCH_REACH;
}

// Adds a position, in ascending order, unless the ray is far from the pivot there or another position is near.
FN int crossed_add(crossed_place* places, int count, crossed_place place) {
    int i;
    if (!crossed_is_near(place)) return count;
    for (i = 0; i < count; ++i)
        if (real_abs(places[i].along - place.along) < CROSSED_APART) return count;
    for (i = count; i > 0 && places[i - 1].along > place.along; --i) places[i] = places[i - 1];
    places[i] = place;
    return count + 1;
}

// The positions where the ray passes pivots; if it passes no pivot, the ray's origin.
FN int crossed_places(GLOBAL const real* p, u32 method, vec3 o, vec3 d, crossed_place* places) {
    int i, count = 0;
    for (i = 0; i < CROSSED_PIVOTS && method != QUARTIC_UNSHIFTED; ++i) {
        GLOBAL const real* pivot = p + CROSSED_FIRST + 4 * i;
        const vec3 from = make_vec3(o.x, o.y, o.z - pivot[0]);
        const real closest = -dot3(from, d);
        if (pivot[3] == 0) {
            count = crossed_add(places, count, crossed_at(pivot, o, d, closest));
        } else if (pivot[3] > 0) {
            // The circle lies on a ball around the axis's point at the pivot's height.
            const vec3 at = add_scaled(from, closest, d);
            const real reach = real_sqrt(real_max(REAL(0), real_fma(pivot[3], pivot[3], -dot3(at, at))));
            count = crossed_add(places, count, crossed_at(pivot, o, d, crossed_closest(pivot, o, d, closest - reach)));
            count = crossed_add(places, count, crossed_at(pivot, o, d, crossed_closest(pivot, o, d, closest + reach)));
        }
    }
    if (count == 0) places[count++] = crossed_plain(o);
    return count;
}

// The limit between the quartics of two neighbouring positions: about half-way, where the two have the same sign.
FN real crossed_between(quartic g, real first, quartic next, real second) {
    real share = REAL(0.5);
    int step;
    for (step = 1; step < 8; ++step) {
        const real u = real_fma(share, second - first, first);
        if ((quartic_at(g, u - first) < 0) == (quartic_at(next, u - second) < 0)) return u;
        share = REAL(0.5) + (step & 1 ? REAL(0.0625) : REAL(-0.0625)) * (real)((step + 1) / 2);
    }
    return REAL(0.5) * (first + second);
}

NOINLINE_FN segments crossed_eto_intersect(Geometry tables, SolidRecord solid, ray3 r) {
    GLOBAL const real* p = tables.reals + solid.first_real;
    const u32 method = QUARTIC_OF(tables);
    const eto_piece s = eto_piece_of(p, method, r);
    crossed_place places[CROSSED_PLACES];
    real roots[4 * CROSSED_PLACES];
    int count = 0, place_count, i, k;
    real low = s.low;
    quartic g;
    if (!(s.low < s.high)) return no_segments();
    place_count = crossed_places(p, method, s.l.o, s.d, places);
    g = crossed_quartic(p, places[0], s.d);
    for (i = 0; i < place_count; ++i) {
        const crossed_place place = places[i];
        real high = s.high;
        quartic next = g;
        int found;
        if (i + 1 < place_count) {
            next = crossed_quartic(p, places[i + 1], s.d);
            high = real_min(high, crossed_between(g, place.along, next, places[i + 1].along));
        }
        if (low < high) {
            found = quartic_roots(method, g, low - place.along, high - place.along, roots + count);
            for (k = 0; k < found; ++k, ++count) {
                const real u = roots[count];
                const int far = !place.plain && real_abs(u) > ETO_PINCH_REACH;
                const real along = far ? crossed_polish(p, crossed_plain(s.l.o), s.d, u + place.along)
                                       : crossed_polish(p, place, s.d, u) + place.along;
                roots[count] = s.l.shift + along / s.length;
                if (count > 0 && roots[count] < roots[count - 1]) roots[count] = roots[count - 1];
            }
            low = high;
        }
        g = next;
    }
    return spans_between(whole_line(), 0, roots, count > 4 ? 4 : count & ~1, 0);
}

// The normal of the factor that vanishes; It is reversed where the other factor is negative: there the inside of this
// factor is the solid's outside.
NOINLINE_FN vec3 crossed_eto_normal(GLOBAL const real* p, ray3 r, real t) {
    const vec3 at = local_point(to_local(p, r), t), still = make_vec3(0, 0, 0);
    const real rho = real_sqrt(real_fma(at.x, at.x, at.y * at.y));
    const real here = crossed_form(p, crossed_plain(at), still, 0, REAL(1)).value;
    const real image = crossed_form(p, crossed_plain(at), still, 0, REAL(-1)).value;
    const real side = real_abs(image) < real_abs(here) ? REAL(-1) : REAL(1);
    const real outward = (side > 0 ? image : here) < 0 ? REAL(-1) : REAL(1);
    const real radial = side * rho - REAL(1);
    const real by_radial = outward * (side * (real_fma(p[12], radial, p[13] * at.z) / rho));
    return affine_normal(
        p, make_vec3(at.x * by_radial, at.y * by_radial, outward * real_fma(p[13], radial, p[14] * at.z)));
}

#endif
