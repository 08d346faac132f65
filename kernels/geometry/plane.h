// Planes are stored in one world-space table and intersected in world space, never through a solid's own matrix. So two
// solids that share a plane compute the same t to the last bit, and the sort sees an exact tie.
#ifndef CSGRT_GEOMETRY_PLANE_H
#define CSGRT_GEOMETRY_PLANE_H

#include "segments.h"

FN wide3 plane_normal(PlaneRecord p) { return make_wide3(p.nx, p.ny, p.nz); }
FN real plane_above(PlaneRecord p, ray3 r) {
    return REAL(wide_dot(plane_normal(p), r.o) - p.d);
}  // the origin's distance

// Does the ray run in the plane, as far as rounding lets csgrt tell?
FN lane_mask runs_in(PlaneRecord plane, ray3 r) {
    const real above = plane_above(plane, r), rate = dot3(narrow(plane_normal(plane)), r.d);
    const real from_origin = sum_of_sizes(narrow(r.o)) + real_abs(REAL(plane.d));
    return real_abs(rate) <= ROUNDING * sum_of_sizes(r.d) && real_abs(above) <= ROUNDING * from_origin;
}

// Clips `s` to the side n . p <= d of a plane, in units of the ray's direction. An empty result has low >= high. A ray
// that is parallel to the plane, as far as rounding lets csgrt tell, stays on its side. A ray that runs in the plane is
// on the side that is kept: it touches the face, whatever rounding does.
FN span clip(span s, PlaneRecord plane, u32 flipped, ray3 r, u32 surface) {
    const real above = plane_above(plane, r), rate = dot3(narrow(plane_normal(plane)), r.d), t = -above / rate;
    const lane_mask parallel = real_abs(rate) <= ROUNDING * sum_of_sizes(r.d);
    lane_mask enters = flipped ? rate > 0 : rate < 0, leaves = flipped ? rate < 0 : rate > 0;
    if (!no_lane(parallel)) {
        const real sizes = sum_of_sizes(narrow(r.o)) + real_abs(REAL(plane.d));
        const lane_mask within = parallel && real_abs(above) <= ROUNDING * sizes;
        const lane_mask outside = parallel && !within && (flipped ? above < 0 : above > 0);
        enters = enters && !parallel;
        leaves = leaves && !parallel;
        s.touched = s.touched || within;
        s.low = outside ? REAL_INFINITY : s.low;
        s.high = outside ? -REAL_INFINITY : s.high;
    }
    {
        const lane_mask raises = enters && t > s.low, lowers = leaves && t < s.high;
        s.low_surface = raises ? TAG(surface) : s.low_surface;
        s.high_surface = lowers ? TAG(surface) : s.high_surface;
        s.low = raises ? t : s.low;
        s.high = lowers ? t : s.high;
    }
    return s;
}

FN span clip_to_face(span s, Geometry g, u32 index, ray3 r, u32 surface) {
    PlaneRef ref = g.words[index];
    return clip(s, g.planes[ref >> 1], ref & 1u, r, surface);
}

// The distance where the ray meets the plane: the same t, to the last bit, as in clip(). It is not finite if the ray is
// parallel to the plane.
FN real face_distance(Geometry g, u32 index, ray3 r) {
    PlaneRecord plane = g.planes[g.words[index] >> 1];
    return -plane_above(plane, r) / dot3(narrow(plane_normal(plane)), r.d);
}

FN vec3 face_normal(Geometry g, u32 index) {
    PlaneRef ref = g.words[index];
    vec3 n = narrow(plane_normal(g.planes[ref >> 1]));
    return (ref & 1u) ? scale(n, REAL(-1)) : n;
}

#endif
