// From a ray's number to the ray. Rays of a picture are numbered in blocks of 8 x 8 pixels, row by row from the top left.
#ifndef CSGRT_CAMERA_H
#define CSGRT_CAMERA_H

#include "shared/layout.h"

typedef struct {
    u32 x, y;  // from the top left
    int inside;
} pixel_position;

FN pixel_position pixel_of(u32 ray, u32 width, u32 height) {
    pixel_position p;
    u32 blocks_across = (width + BLOCK - 1u) / BLOCK;
    u32 block = ray / (BLOCK * BLOCK);
    u32 within = ray % (BLOCK * BLOCK);
    p.x = block % blocks_across * BLOCK + within % BLOCK;
    p.y = block / blocks_across * BLOCK + within / BLOCK;
    p.inside = p.x < width && p.y < height;
    return p;
}

FN ray3 camera_ray(GLOBAL const Frame* f, pixel_position at) {
    ray3 r;
    real x = REAL(at.x) + REAL(0.5) - REAL(0.5) * REAL(f->width);
    real y = REAL(0.5) * REAL(f->height) - REAL(at.y) - REAL(0.5);
    vec3 eye = make_vec3(f->eye[0], f->eye[1], f->eye[2]);
    vec3 w = make_vec3(f->w[0], f->w[1], f->w[2]);
    vec3 across = add_scaled(scale(make_vec3(f->u[0], f->u[1], f->u[2]), x), y, make_vec3(f->v[0], f->v[1], f->v[2]));
    if (f->perspective) {
        r.o = eye;
        r.d = normalize3(add(w, across));
    } else {
        r.o = add(eye, across);
        r.d = w;
    }
    return r;
}

// The ray of a number: from the list of rays if there is one, else through a pixel. Returns 0 if there is no such ray.
FN int ray_of(GLOBAL const Frame* f, GLOBAL const RayRecord* rays, u32 number, ray3* r) {
    if (f->listed) {
        RayRecord record = rays[number];
        r->o = make_vec3(record.ox, record.oy, record.oz);
        r->d = make_vec3(record.dx, record.dy, record.dz);
        return 1;
    } else {
        pixel_position at = pixel_of(number, f->width, f->height);
        *r = camera_ray(f, at);
        return at.inside;
    }
}

// The frame's tolerance in units of the ray's own direction, which a listed ray brings in any length.
FN real tolerance_along(GLOBAL const Frame* f, ray3 r) {
    vec3 d = r.d;
    real longest = real_max(real_abs(d.x), real_max(real_abs(d.y), real_abs(d.z)));
    if (!f->listed) return f->tolerance;
    d = scale(d, REAL(1) / longest);  // the squares of 1e-200 and of 1e200 are no numbers
    return f->tolerance / (longest * real_sqrt(dot3(d, d)));
}

#endif
