// The first hits of a packet of rays, drawn (first_hits.cl): a row of eight pixels.
#ifndef CSGRT_FIRST_HITS_PACKET_H
#define CSGRT_FIRST_HITS_PACKET_H

#include "packet_pixels.h"

#define RAYS_AN_ITEM PACKET

FN void start_packet(packet* p, __global const Frame* f, pixel_position first) {
    const double8 x = (double)first.x + (double8)(0, 1, 2, 3, 4, 5, 6, 7);
    const packet_world_ray from_eye = view_ray(f, x, (double8)((double)first.y));
    u32 k;
    for (k = 0; k < PACKET; ++k) {
        start_front(p->fronts + k);
        p->due[k] = BOX_MISSED;
    }
    p->rays.o = from_eye.o;
    p->rays.d = from_eye.d;
    p->lanes = lanes_of(p->rays);
    p->t_min = f->t_min;
    p->tolerance = f->tolerance;
    p->offset = distance_of_center(f);
    p->slabs = make_slab_ray(offset_from(packet_make_wide3(f->center[0], f->center[1], f->center[2]), from_eye.o), from_eye.d,
                             f->radius, f->t_min);
}

// Draws the pixels from `first` on that are in the picture; the channels of the first begin at `picture`. Returns the rays
// that had no room, of which nothing is drawn. `seen`: those that see anything.
FN u32 draw(__global const Frame* f, scene_tables s, appearance_tables a, __global const BlockNode* list, pixel_position first,
            __global float* picture, u32* seen) {
    u32 within = 0, hit, lost, k;
    packet p;
    start_packet(&p, f, first);
    for (k = 0; k < PACKET; ++k) within |= first.x + k < f->window.right ? 1u << k : 0;
    hit = first_hits_of(&p, f, s, list, within, &lost);
    put_pixels(&p, f, s.g, a, picture, within & ~lost, hit);
    *seen = hit;
    return lost;
}

#endif
