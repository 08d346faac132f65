// First hits as processors draw them: one packet a work-item (first_hits.cl), two rows of four pixels.
#ifndef CSGRT_PACKET_FIRST_HITS_PACKET_H
#define CSGRT_PACKET_FIRST_HITS_PACKET_H

#include "pixels.h"
#include "../geometry/beyond.h"

#define RAYS_AN_ITEM PACKET
#define FIRST_OF_ITEM(id) first_of_packet(id)
#define RAY_OF_ITEM(k) ray_of_packet(k)

FN void start_packet(packet* p, __global const Frame* f, pixel_position first) {
    const packet_world_ray from_eye = rays_through(f, first);
    sweep_units units;
    real after[PACKET];
    u32 k;
    p->range = range_in_view(f, from_eye);
    vstore8(p->range.after, 0, after);
    units.tolerance = f->tolerance;
    units.unit = units.per_unit = 1;
    units.offset = distance_of_center(f);
    for (k = 0; k < PACKET; ++k) {
        start_sweep(p->sweeps + k);
        p->next_events[k] = BOX_MISSED;
        p->units[k] = units;
        p->units[k].after = after[k];
    }
    p->rays.o = from_eye.o;
    p->rays.d = from_eye.d;
    p->lanes = lanes_of(p->rays);
    p->t_min = p->range.from;
    p->slabs = slabs_of(f, from_eye, p->t_min);
    if (f->clip_count && any(p->range.in_plane)) {
        const u32 in_plane = bits_of(p->range.in_plane);
        for (k = 0; k < PACKET; ++k)
            if (in_plane >> k & 1u) p->sweeps[k].beyond = sides_beyond(f, lane(&p->lanes, k));
    }
}

// The rays of the hit mask that hit before their ranges end.
FN u32 hits_before(const packet* p, u32 hit_mask) {
    real before[PACKET];
    u32 k;
    vstore8(p->range.before, 0, before);
    for (k = 0; k < PACKET; ++k)
        if ((hit_mask >> k & 1u) && !(p->sweeps[k].seen.t < before[k])) hit_mask ^= 1u << k;
    return hit_mask;
}

// Draws the pixels from `first` on that are in the picture; the channels of the first begin at `picture`. Returns the
// overflow mask: the rays of which nothing is drawn. *hit_mask: the rays that see anything.
FN u32 draw(__global const Frame* f, scene_tables s, appearance_tables a, __global const TileNode* list,
            pixel_position first, __global float* picture, u32* hit_mask) {
    const u32 within = rays_inside(f, first);
    u32 overflow_mask, sees;
    packet p;
    start_packet(&p, f, first);
    sees = f->clip_count ? bits_of(p.range.after < p.range.before) & within : within;
    *hit_mask = first_hits_of(&p, f, s, a.materials, list, sees, &overflow_mask);
    if (f->clip_count) *hit_mask = hits_before(&p, *hit_mask);
    put_pixels(&p, f, s.g, a, picture, within & ~overflow_mask, *hit_mask);
    return overflow_mask;
}

#endif
