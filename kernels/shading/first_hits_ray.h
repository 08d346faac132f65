// First hits as GPUs draw them: one ray a work-item (first_hits.cl).
#ifndef CSGRT_SHADING_FIRST_HITS_RAY_H
#define CSGRT_SHADING_FIRST_HITS_RAY_H

#include "../boolean/first_hit.h"
#include "../geometry/beyond.h"
#include "pixel.h"

#define RAYS_AN_ITEM 1u
#define FIRST_OF_ITEM(id) (id)
#define RAY_OF_ITEM(k) (k)

// Draws the pixel at `at`, whose channels begin at `picture`. Returns the overflow mask: 1 if the ray has more segments
// at a time than a sweep holds; then nothing is drawn. *hit_mask: 1 if the ray sees anything.
FN u32 draw(__global const Frame* f, scene_tables s, appearance_tables a, __global const TileNode* list,
            pixel_position at, __global float* picture, u32* hit_mask) {
    const world_ray from_eye = camera_ray(f, at);
    const view_range visible = range_in_view(f, from_eye);
    const ray3 r = geometry_ray(f, from_eye);
    sweep w;
    const u32 beyond = visible.in_plane ? sides_beyond(f, r) : 0;
    u32 found = first_hit(f, s, list, r, parameter_at(r, visible.from), parameter_at(r, visible.after), beyond, &w);
    Pixel pixel;
    if (found == RAY_HITS && !(w.seen.t < parameter_at(r, visible.before) && visible.after < visible.before))
        found = RAY_MISSES;
    *hit_mask = found == RAY_HITS;
    if (found == RAY_OVERFLOWS) return 1;
    if (found == RAY_HITS) {
        const MaterialRecord material = a.materials[w.region];
        pixel = seen_pixel(f, a.lights, material, s.g, r, visible, w.seen, w.from_within, w.region);
    } else {
        pixel = background_pixel(f);
    }
    put_pixel(f, a.display, picture, pixel);
    return 0;
}

#endif
