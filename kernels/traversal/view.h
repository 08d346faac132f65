// The ray through the middle of a pixel.
#ifndef CSGRT_TRAVERSAL_VIEW_H
#define CSGRT_TRAVERSAL_VIEW_H

#include "../shared/layout.h"

// Column and row from the top left.
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

// Which part of a picture's ray is seen, by distance: from `near` to `far`, if that is more. `plane`: which of the
// frame's planes cuts it where it begins, or NO_PLANE.
typedef struct {
    wide near, far;
    tag plane;
} view_range;
#define NO_PLANE MOST_CLIPS

FN view_range range_in_view(GLOBAL const Frame* f, world_ray r) {
    view_range visible;
    u32 k;
    visible.near = (wide)f->t_min;
    visible.far = (wide)REAL_INFINITY;
    visible.plane = TAG(NO_PLANE);
    for (k = 0; k < f->clip_count; ++k) {
        const wide3 n = make_wide3((wide)f->clip[k][0], (wide)f->clip[k][1], (wide)f->clip[k][2]);
        const wide beyond = wide_dot(n, r.o) - (wide)f->clip[k][3], along = wide_dot(n, r.d), t = -beyond / along;
        const lane_mask comes = along < 0 && t > visible.near, goes = along > 0 && t < visible.far,
                        is_gone = along == 0 && beyond > 0;
        visible.near = comes ? t : visible.near;
        visible.plane = comes ? TAG(k) : visible.plane;
        visible.far = goes ? t : visible.far;
        visible.far = is_gone ? (wide)-REAL_INFINITY : visible.far;
    }
    return visible;
}

#endif
