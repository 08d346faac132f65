// Pixel: computes the channels of a pixel from the hit of its ray.
#ifndef CSGRT_SHADING_PIXEL_H
#define CSGRT_SHADING_PIXEL_H

#include "../traversal/camera.h"
#include "../geometry/solid.h"
#include "plastic.h"

// The tables of the regions' appearance.
typedef struct {
    GLOBAL const MaterialRecord* materials;  // one a region
    GLOBAL const LightRecord* lights;
    GLOBAL const DisplayBytes* display;
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

// The values of a pixel. The ray meets the region `region` at the boundary `seen`. If the region begins where another
// solid ends (`from_within`), that solid's surface is seen from within: the normal is flipped. Only here is a normal
// computed: one a ray. If a plane of the frame cuts the region open, the plane is seen, and no solid's surface.
FN Pixel seen_pixel(GLOBAL const Frame* f, GLOBAL const LightRecord* lights, MaterialRecord m, Geometry g, ray3 r,
                    view_range visible, Boundary seen, u32 from_within, u32 region) {
    const real near = parameter_at(r, visible.near);
    const u32 is_cut = visible.plane != NO_PLANE && seen.t < near;
    vec3 n;
    Pixel p;
    if (is_cut) {
        n = narrow(plane_normal(f->clip[visible.plane]));
        seen.t = near;
    } else {
        n = normal_at(g, g.solids[seen.solid], r, seen.t, seen.surface);
        if (from_within) n = scale(n, REAL(-1));
    }
    p = hit_pixel(shade_plastic(f, lights, finish_of(m), r, seen.t, n, near), r);
    p.region = region + 1;
    p.solid = is_cut ? 0 : seen.solid + 1;
    return p;
}

// A display's byte for an amount of light; 0 if `light` is a NaN.
FN u32 byte_of_light(GLOBAL const DisplayBytes* display, float light) {
    u32 byte, part;
    if (!(light > 0)) return 0;
    if (light >= 1) return 255;
    part = (u32)(light * DISPLAY_PARTS);
    byte = display->first[part / 4u] >> part % 4u * 8u & 255u;
    while (light >= display->ends[byte]) ++byte;
    return byte;
}
FN u32 display_word(GLOBAL const DisplayBytes* display, float r, float g, float b, float alpha) {
    return byte_of_light(display, r) | byte_of_light(display, g) << 8 | byte_of_light(display, b) << 16 |
           (alpha > 0 ? 0xff000000u : 0);
}

// Stores the values of a pixel, channel by channel; `picture`: the pixel's position in the first channel.
FN void put_pixel(GLOBAL const Frame* f, GLOBAL const DisplayBytes* display, GLOBAL float* picture, Pixel p) {
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
        ((GLOBAL u32*)picture)[0] = p.region;
        ((GLOBAL u32*)picture)[size] = p.solid;
        picture += 2 * size;
    }
    if (f->channels & CHANNEL_COUNTS) {
        picture[0] = (float)p.depth;
        picture[size] = (float)p.partitions;
        picture[2 * size] = (float)p.overlap;
        picture += 3 * size;
    }
    if (f->channels & CHANNEL_DISPLAY)
        *(GLOBAL u32*)picture = display_word(display, p.rgba[0], p.rgba[1], p.rgba[2], p.rgba[3]);
}

#endif
