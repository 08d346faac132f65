// View: the ray through the middle of a pixel, and its visible range.
#ifndef CSGRT_TRAVERSAL_VIEW_H
#define CSGRT_TRAVERSAL_VIEW_H

#include "../shared/layout.h"

// The ray of a column and a row, from the top left.
FN world_ray view_ray(GLOBAL const Frame* f, wide column, wide row) {
    world_ray r;
    wide x = column + (wide)f->first_x;
    wide y = (wide)f->first_y - row;
    wide3 eye = make_wide3(f->eye[0], f->eye[1], f->eye[2]);
    wide3 w = make_wide3(f->w[0], f->w[1], f->w[2]);
    wide3 across =
        wide_add_scaled(wide_scale(make_wide3(f->u[0], f->u[1], f->u[2]), x), y, make_wide3(f->v[0], f->v[1], f->v[2]));
    if (f->perspective) {
        wide3 d = make_wide3(w.x + across.x, w.y + across.y, w.z + across.z);
        r.o = eye;
        r.d = wide_scale(d, (wide)1 / wide_sqrt(wide_dot(d, d)));
    } else {
        r.o = make_wide3(eye.x + across.x, eye.y + across.y, eye.z + across.z);
        r.d = w;
    }
    return r;
}

// The visible range of a picture's ray, by distance. A plane of the view is a boundary like the boundaries of solids: a
// surface that is nearer to the plane than the tolerance counts as lying in the plane.
typedef struct {
    wide from;           // segments that end before it are not wanted
    wide near;           // the nearest visible distance
    wide after;          // partitions that end here or before are not seen,
    wide before;         // and partitions that begin here or behind are not seen
    tag plane;           // which of the frame's planes cuts the ray at `near`, or NO_PLANE
    lane_mask in_plane;  // the ray runs in some plane (geometry/beyond.h)
} view_range;
#define NO_PLANE MOST_CLIPS

FN wide sum_of_wide_sizes(wide3 v) { return wide_abs(v.x) + wide_abs(v.y) + wide_abs(v.z); }

// The range between the planes. The planes cut as half-spaces do (clip() of geometry/plane.h), at the same distances.
FN view_range range_in_view(GLOBAL const Frame* f, world_ray r) {
    view_range visible;
    wide far = (wide)REAL_INFINITY, slack;
    u32 k;
    visible.near = (wide)f->t_min;
    visible.plane = TAG(NO_PLANE);
    visible.in_plane = 0;
    for (k = 0; k < f->clip_count; ++k) {
        const PlaneRecord plane = f->clip[k];
        const wide3 n = make_wide3((wide)plane.nx, (wide)plane.ny, (wide)plane.nz);
        const wide beyond = wide_dot(n, r.o) - (wide)plane.d, along = wide_dot(n, r.d), t = -beyond / along;
        const lane_mask parallel = wide_abs(along) <= (wide)ROUNDING * sum_of_wide_sizes(r.d);
        const lane_mask within =
            parallel && wide_abs(beyond) <= (wide)ROUNDING * (sum_of_wide_sizes(r.o) + wide_abs((wide)plane.d));
        const lane_mask comes = !parallel && along < 0 && t > visible.near, goes = !parallel && along > 0 && t < far,
                        is_gone = parallel && !within && beyond > 0;
        visible.near = comes ? t : visible.near;
        visible.plane = comes ? TAG(k) : visible.plane;
        far = goes ? t : far;
        far = is_gone ? (wide)-REAL_INFINITY : far;
        visible.in_plane = visible.in_plane || within;
    }
    slack = visible.plane == TAG(NO_PLANE) ? (wide)0 : (wide)f->tolerance;
    visible.from = visible.near - slack;
    visible.after = visible.near + slack;
    visible.before = far - (wide)f->tolerance;
    return visible;
}

#endif
