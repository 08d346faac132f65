// Listed: a packet of a list is eight consecutive rays, each with its range.
#ifndef CSGRT_PACKET_LISTED_H
#define CSGRT_PACKET_LISTED_H

#include "packet.h"

// Eight rays, and a mask of the rays that exist.
typedef struct {
    packet_world_ray rays;
    double8 t_min, t_max;
    u32 within;  // a mask
    u32 number;  // of the first ray of a picture
} ray_packet;

FN ray_packet listed_packet(__global const Frame* f, __global const RayRecord* rays, u32 id) {
    const u32 count = f->ray_count - id < PACKET ? f->ray_count - id : PACKET;
    double of[8][PACKET];
    ray_packet p;
    u32 k;
    for (k = 0; k < PACKET; ++k) {
        const RayRecord record = rays[id + (k < count ? k : 0)];
        const ray_range wanted = range_of(f, record, geometry_ray(f, listed_ray(record)));
        of[0][k] = record.ox;
        of[1][k] = record.oy;
        of[2][k] = record.oz;
        of[3][k] = record.dx;
        of[4][k] = record.dy;
        of[5][k] = record.dz;
        of[6][k] = wanted.t_min;
        of[7][k] = wanted.t_max;
    }
    p.rays.o = packet_make_wide3(vload8(0, of[0]), vload8(0, of[1]), vload8(0, of[2]));
    p.rays.d = packet_make_vec3(vload8(0, of[3]), vload8(0, of[4]), vload8(0, of[5]));
    p.t_min = vload8(0, of[6]);
    p.t_max = vload8(0, of[7]);
    p.within = (1u << count) - 1u;
    p.number = 0;
    return p;
}

#endif
