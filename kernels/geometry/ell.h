// Ellipsoid and sphere: the affine image of x^2 + y^2 + z^2 = 1. Parameters: affine (12). Surface 0. With q the local
// ray's point closest to the center, the hits are at u = u(q) -+ sqrt((1 - q.q) / d.d).
#ifndef CSGRT_GEOMETRY_ELL_H
#define CSGRT_GEOMETRY_ELL_H

#include "affine.h"

FN segments ell_intersect(GLOBAL const parameter* p, ray3 r) {
    local_ray l = to_local(p, r);
    real dd = dot3(l.d, l.d);
    real residue = dot3(l.o, l.d) / dd;
    vec3 q = add_scaled(l.o, -residue, l.d);
    real inside = REAL(1) - dot3(q, q);
    real reach, middle;
    if (no_lane(inside > 0)) return no_segments();
    reach = real_sqrt(inside / dd);
    middle = l.shift - residue;
    return touching(inside > 0 && inside < TOUCHED, append(no_segments(), middle - reach, 0, middle + reach, 0));
}

FN vec3 ell_normal(GLOBAL const parameter* p, ray3 r, real t) {
    return affine_normal(p, local_point(to_local(p, r), t));
}

#endif
