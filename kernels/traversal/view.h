// The ray through the middle of a pixel.
#ifndef CSGRT_TRAVERSAL_VIEW_H
#define CSGRT_TRAVERSAL_VIEW_H

#include "../shared/layout.h"

// Column and row from the top left.
FN world_ray view_ray(GLOBAL const Frame* f, wide column, wide row) {
    world_ray r;
    wide x = column + (wide)0.5 - (wide)0.5 * (wide)f->width;
    wide y = (wide)0.5 * (wide)f->height - row - (wide)0.5;
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

#endif
