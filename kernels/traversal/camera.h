// Camera: makes the ray of a number. Rays of a picture are numbered in tiles of 8 x 8 pixels of its screen, row by row
// from the top left.
#ifndef CSGRT_TRAVERSAL_CAMERA_H
#define CSGRT_TRAVERSAL_CAMERA_H

#include "view.h"

// The pixel of a ray; `inside` is 0 if this pixel of the tile lies outside the picture.
typedef struct {
    u32 x, y;  // from the top left
    int inside;
} pixel_position;

FN pixel_position pixel_of(u32 ray, ScreenBounds w) {
    pixel_position p;
    const u32 across = tiles_across(w), tile = ray / (TILE * TILE), within = ray % (TILE * TILE);
    p.x = w.left + tile % across * TILE + within % TILE;
    p.y = w.top + tile / across * TILE + within / TILE;
    p.inside = p.x < w.right && p.y < w.bottom;
    return p;
}

// A pixel's index in a row-major picture of the screen's whole rows, from the top of a batch's first tile on.
FN size_t row_major_place(ScreenBounds w, u32 first_ray, pixel_position at) {
    const u32 top = w.top + first_ray / (TILE * TILE) / tiles_across(w) * TILE;
    return (size_t)(at.y - top) * width_of(w) + (at.x - w.left);
}

// The index of a ray's pixel in a channel of the batch's picture, and how many floats a channel has.
FN size_t place_of(GLOBAL const Frame* f, pixel_position at, u32 id) {
    return f->rows ? row_major_place(f->screen, f->first_ray, at) : id;
}
FN size_t channel_size(GLOBAL const Frame* f) { return f->rows ? (size_t)f->rows * width_of(f->screen) : f->ray_count; }

// Marks the ray's tile, for the host, as a tile that shows something. Several rays may store the mark at once: all
// store the same value.
FN void mark_shown(GLOBAL const Frame* f, GLOBAL BatchReport* report, u32 number) {
    if (f->rows) ((GLOBAL unsigned char*)(report + 1))[(number - f->first_ray) / (TILE * TILE)] = 1;
}

FN world_ray camera_ray(GLOBAL const Frame* f, pixel_position at) { return view_ray(f, (wide)at.x, (wide)at.y); }

FN wide3 frame_center(GLOBAL const Frame* f) { return make_wide3(f->center[0], f->center[1], f->center[2]); }

#ifdef CSGRT_EYE_RELATIVE
// Makes the ray for the geometry. The direction becomes a unit vector; an origin outside the sphere around the scene is
// moved to its closest approach to the center. So distances along the ray are small wherever there is a solid.
FN ray3 geometry_ray(GLOBAL const Frame* f, world_ray w) {
    ray3 r;
    wide3 from = wide_subtract(w.o, frame_center(f));
    if (f->work == WORK_RAYS) {
        wide longest = wide_max(wide_abs(w.d.x), wide_max(wide_abs(w.d.y), wide_abs(w.d.z)));
        w.d = wide_scale(w.d, (wide)1 / longest);
        w.d = wide_scale(w.d, (wide)1 / wide_sqrt(wide_dot(w.d, w.d)));
    }
    r.start = f->radius > 0 && wide_dot(from, from) > f->radius * f->radius ? -wide_dot(from, w.d) : 0;
    r.o = wide_add_scaled(w.o, r.start, w.d);
    r.d = narrow(w.d);
    r.center = make_wide3(0, 0, 0);
    return r;
}
FN real t_min_along(GLOBAL const Frame* f, ray3 r) { return REAL(f->t_min - r.start); }
FN real parameter_at(ray3 r, wide distance) { return REAL(distance - r.start); }
FN wide distance_along(ray3 r, real t) { return r.start + (wide)t; }  // from the ray's own origin
#else
FN ray3 geometry_ray(GLOBAL const Frame* f, world_ray w) {
    ray3 r;
    (void)f;
    r.o = w.o;
    r.d = w.d;
    return r;
}
FN real t_min_along(GLOBAL const Frame* f, ray3 r) {
    (void)r;
    return f->t_min;
}
FN real parameter_at(ray3 r, wide distance) {
    (void)r;
    return REAL(distance);
}
FN real distance_along(ray3 r, real t) {
    (void)r;
    return t;
}
#endif

// The wanted range of a ray: segments that end before t_min or begin behind t_max are left out.
typedef struct {
    real t_min, t_max;
} ray_range;

// The range for boxes: a box that lies outside it has no wanted segment. A ray that grazes a plate is in the plate far
// before and behind the plate's box.
FN ray_range range_of_boxes(GLOBAL const Frame* f, ray_range wanted) {
    wanted.t_min = f->whole_lines ? -REAL_INFINITY : wanted.t_min;
    wanted.t_max = f->whole_lines ? REAL_INFINITY : wanted.t_max;
    return wanted;
}

FN wide largest_of(wide3 d) { return wide_max(wide_abs(d.x), wide_max(wide_abs(d.y), wide_abs(d.z))); }

FN world_ray listed_ray(RayRecord record) {
    world_ray w;
    w.o = make_wide3(record.ox, record.oy, record.oz);
    w.d = make_wide3(record.dx, record.dy, record.dz);
    return w;
}

// The unit of a listed ray's distances: the length of its direction; 1 where geometry_ray keeps the length.
FN wide unit_of(world_ray w) {
#ifdef CSGRT_EYE_RELATIVE
    const wide largest = largest_of(w.d);
    const wide3 d = wide_scale(w.d, (wide)1 / largest);
    return largest * wide_sqrt(wide_dot(d, d));
#else
    (void)w;
    return 1;
#endif
}

// A listed ray's range, wider by at least the tolerance. So boundaries near its limits join the same events as on the
// whole line.
FN ray_range range_of(GLOBAL const Frame* f, RayRecord record, ray3 r) {
    ray_range wanted;
#ifdef CSGRT_EYE_RELATIVE
    const wide unit = unit_of(listed_ray(record)), slack = f->tolerance;
    wanted.t_min = REAL(record.t_near * unit - r.start - slack);
    wanted.t_max = REAL(record.t_far * unit - r.start + slack);
#else
    const wide slack = f->tolerance / largest_of(listed_ray(record).d);
    (void)r;
    wanted.t_min = record.t_near - slack;
    wanted.t_max = record.t_far + slack;
#endif
    return wanted;
}

// The number of the batch's ray `id`. `listed`: numbers of tiles or of pixels, see WORK_x.
FN u32 number_of(GLOBAL const Frame* f, GLOBAL const u32* listed, u32 id) {
    if (f->work == WORK_RAYS) return id;
    return f->work == WORK_PIXELS ? listed[id] : listed[id / (TILE * TILE)] * (TILE * TILE) + id % (TILE * TILE);
}

// Makes ray `number` of a list or of a picture. Returns 0 if there is no such ray.
FN int ray_of(GLOBAL const Frame* f, GLOBAL const RayRecord* rays, u32 number, ray3* r, ray_range* wanted) {
    if (f->work == WORK_RAYS) {
        const RayRecord record = rays[number];
        *r = geometry_ray(f, listed_ray(record));
        *wanted = range_of(f, record, *r);
        return 1;
    } else {
        pixel_position at = pixel_of(number, f->screen);
        const world_ray w = camera_ray(f, at);
        *r = geometry_ray(f, w);
        wanted->t_min = parameter_at(*r, range_in_view(f, w).from);
        wanted->t_max = REAL_INFINITY;
        return at.inside;
    }
}

// The frame's tolerance in units of the ray's own direction: a listed ray's direction may have any length.
FN real tolerance_along(GLOBAL const Frame* f, ray3 r) {
#ifdef CSGRT_EYE_RELATIVE
    (void)r;
    return REAL(f->tolerance);
#else
    vec3 d = r.d;
    real longest = real_max(real_abs(d.x), real_max(real_abs(d.y), real_abs(d.z)));
    if (f->work != WORK_RAYS) return f->tolerance;
    d = scale(d, REAL(1) / longest);  // the squares of 1e-200 and of 1e200 would under- and overflow
    return f->tolerance / (longest * real_sqrt(dot3(d, d)));
#endif
}

#endif
