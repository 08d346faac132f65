// Closed form: intersects a packet's rays with solids that may need more than a closed form, such as a quartic. A ray
// that needs more is UNDECIDED, and is intersected alone.
//
// The file is compiled for packets alone, between packet/begin.h and packet/end.h.
#ifndef CSGRT_PACKET_CLOSED_FORM_H
#define CSGRT_PACKET_CLOSED_FORM_H

#include "../geometry/cone.h"
#include "../geometry/torus.h"

// The count of segments of a ray that this file cannot decide.
#define UNDECIDED 3u

FN segments undecided_where(lane_mask mask, segments h) {
    h.count = mask ? TAG(UNDECIDED) : h.count;
    return h;
}

// The part of a ray inside a quadratic, as in polynomial.h where a > 0. Other rays are undecided.
FN segments quadratic_inside(real a, real b, real c, real discriminant, real shift, span s, u32 surface) {
    return undecided_where(s.low < s.high && !(a > 0), between_roots(a, b, c, discriminant, shift, s, surface));
}

// The segments of a tgc, as in tgc.h, for rays less steep than the cone. The other rays are undecided where a quartic
// has to be solved.
FN segments tgc_intersect(Geometry g, SolidRecord solid, ray3 r) {
    GLOBAL const parameter* p = g.reals + solid.first_real;
    span s = between_ends(g, solid, r);
    local_ray l;
    if (no_lane(s.low < s.high)) return no_segments();
    l = quartic_ray(p[16] == 0 ? QUARTIC_BRACKETED : QUARTIC_OF(g), p, r);
    if (p[16] == 0) {
        const real m0 = real_fma(p[13], l.o.z, p[12]);
        const quadratic f = round_side(l, m0, p[13] * l.d.z);
        const segments h = quadratic_inside(f.a, f.b, f.c, f.discriminant, l.shift, s, TGC_SIDE);
        return touching(s.touched || may_touch_side(l, f, m0), h);
    }
    s = tapered_piece(QUARTIC_OF(g), p, l, s);
    return undecided_where(s.low < s.high, no_segments());
}

// The segments of a tor; a ray is undecided where a quartic has to be solved.
FN segments tor_intersect(Geometry g, SolidRecord solid, ray3 r) {
    const span s = tor_bend(g, solid, r);
    tor_piece piece;
    if (no_lane(s.low < s.high)) return no_segments();
    piece = tor_piece_of(QUARTIC_OF(g), g.reals + solid.first_real, r);
    return undecided_where(s.low < s.high && piece.low < piece.high, no_segments());
}

#endif
