// From what a ray hits to the channels of its pixel.
#ifndef CSGRT_SHADING_PIXEL_H
#define CSGRT_SHADING_PIXEL_H

#include "../traversal/camera.h"
#include "../geometry/solid.h"
#include "plastic.h"

// How regions look.
typedef struct {
    GLOBAL const MaterialRecord* materials;  // one a region
    GLOBAL const LightRecord* lights;
} appearance_tables;

FN Pixel background_pixel(GLOBAL const Frame* f) {
    Pixel p;
    u32 i;
    for (i = 0; i < 4; ++i) p.rgba[i] = f->background[i];
    p.z = (float)REAL_INFINITY;
    p.normal[0] = p.normal[1] = p.normal[2] = 0;
    p.region = p.solid = 0;
    p.depth = p.partitions = p.overlap = 0;
    return p;
}

FN finish finish_of(MaterialRecord m) {
    finish f;
    f.color.r = REAL(m.r);
    f.color.g = REAL(m.g);
    f.color.b = REAL(m.b);
    f.specular = REAL(m.specular);
    f.diffuse = REAL(m.diffuse);
    f.ambient = REAL(m.ambient);
    f.glow = REAL(m.glow);
    f.shine = m.shine;
    return f;
}

FN Pixel hit_pixel(sight s, ray3 r) {
    Pixel p;
    p.rgba[0] = (float)s.color.r;
    p.rgba[1] = (float)s.color.g;
    p.rgba[2] = (float)s.color.b;
    p.rgba[3] = 1;
    p.z = (float)distance_along(r, s.t);
    p.normal[0] = (float)s.n.x;
    p.normal[1] = (float)s.n.y;
    p.normal[2] = (float)s.n.z;
    p.region = p.solid = 0;
    p.depth = p.partitions = p.overlap = 0;
    return p;
}

// Region `region` where the ray comes upon it at the end `seen`. If the region begins where another solid ends
// (`from_within`), that solid's surface is seen from within: the normal is flipped. Only here is a normal computed:
// one a ray.
FN Pixel seen_pixel(GLOBAL const Frame* f, GLOBAL const LightRecord* lights, MaterialRecord m, Geometry g, ray3 r,
                    End seen, u32 from_within, u32 region) {
    vec3 n = normal_at(g, g.solids[seen.solid], r, seen.t, seen.surface);
    Pixel p;
    if (from_within) n = scale(n, REAL(-1));
    p = hit_pixel(shade_plastic(f, lights, finish_of(m), r, seen.t, n, t_min_along(f, r)), r);
    p.region = region + 1;
    p.solid = seen.solid + 1;
    return p;
}

// Stores what a ray sees, channel by channel; `picture`: its place in the batch's first.
FN void put_pixel(GLOBAL const Frame* f, GLOBAL float* picture, Pixel p) {
    const size_t size = channel_size(f);
    u32 i;
    if (f->channels & CHANNEL_COLOR)
        for (i = 0; i < 4; ++i, picture += size) *picture = p.rgba[i];
    if (f->channels & CHANNEL_DISTANCE) {
        *picture = p.z;
        picture += size;
    }
    if (f->channels & CHANNEL_NORMAL)
        for (i = 0; i < 3; ++i, picture += size) *picture = p.normal[i];
    if (f->channels & CHANNEL_IDS) {
        picture[0] = (float)p.region;
        picture[size] = (float)p.solid;
        picture += 2 * size;
    }
    if (f->channels & CHANNEL_COUNTS) {
        picture[0] = (float)p.depth;
        picture[size] = (float)p.partitions;
        picture[2 * size] = (float)p.overlap;
    }
}

#endif
