// BRL-CAD's plastic at a first hit: ambient light from the eye, diffuse and specular light from each light, no shadows.
//
//   colour * (ambient cos(n, eye)) + sum over lights: colour * light * diffuse cos(n, l) + light * specular cos(r, eye)^shine
//
// The power is by squaring: multiplications only, so every device gives the same bits.
#ifndef CSGRT_SHADING_H
#define CSGRT_SHADING_H

#include "camera.h"
#include "geometry/solid.h"

typedef struct {
    real r, g, b;
} rgb;

FN real whole_power(real x, u32 n) {
    real result = 1;
    while (n) {
        if (n & 1u) result = result * x;
        x = x * x;
        n >>= 1;
    }
    return result;
}

// n: unit normal towards the viewer's side of the surface; d: direction of the ray, any length.
FN rgb plastic(GLOBAL const Frame* f, GLOBAL const LightRecord* lights, MaterialRecord m, wide3 at, vec3 n, vec3 d) {
    vec3 view = scale(normalize3(d), REAL(-1));
    real facing = dot3(n, view);
    real ambient = facing > 0 ? facing * REAL(f->ambient) * REAL(m.ambient) : REAL(0);
    rgb c;
    u32 i;
    c.r = ambient * REAL(m.r);
    c.g = ambient * REAL(m.g);
    c.b = ambient * REAL(m.b);
    for (i = 0; i < f->light_count; ++i) {
        LightRecord light = lights[i];
        vec3 to_light = normalize3(narrow(wide_subtract(make_wide3(light.x, light.y, light.z), at)));
        real cosine = dot3(n, to_light);
        real diffuse, mirrored, specular;
        if (!(cosine > 0)) continue;
        diffuse = cosine * REAL(m.diffuse);
        mirrored = dot3(subtract(scale(n, REAL(2) * cosine), to_light), view);
        specular = mirrored > 0 ? whole_power(mirrored, m.shine) * REAL(m.specular) : REAL(0);
        c.r = c.r + REAL(light.r) * (diffuse * REAL(m.r) + specular);
        c.g = c.g + REAL(light.g) * (diffuse * REAL(m.g) + specular);
        c.b = c.b + REAL(light.b) * (diffuse * REAL(m.b) + specular);
    }
    return c;
}

FN Pixel background_pixel(GLOBAL const Frame* f) {
    Pixel p;
    p.rgba[0] = f->background[0];
    p.rgba[1] = f->background[1];
    p.rgba[2] = f->background[2];
    p.rgba[3] = 0;
    p.z = (float)REAL_INFINITY;
    p.normal[0] = p.normal[1] = p.normal[2] = 0;
    p.region = p.solid = 0;
    p.depth = p.partitions = p.overlap = 0;
    return p;
}

// A hit at distance t with the region's outward unit normal n. Inside the region already (t < t_min): the hit is the
// eye itself, seen face on.
FN Pixel hit_pixel(GLOBAL const Frame* f, GLOBAL const LightRecord* lights, MaterialRecord m, ray3 r, real t, vec3 n) {
    Pixel p;
    rgb c;
    if (t < t_min_along(f, r)) {
        t = t_min_along(f, r);
        n = scale(normalize3(r.d), REAL(-1));
    }
    c = plastic(f, lights, m, wide_add_scaled(r.o, t, widen(r.d)), n, r.d);
    p.rgba[0] = (float)c.r;
    p.rgba[1] = (float)c.g;
    p.rgba[2] = (float)c.b;
    p.rgba[3] = 1;
    p.z = (float)distance_along(r, t);
    p.normal[0] = (float)n.x;
    p.normal[1] = (float)n.y;
    p.normal[2] = (float)n.z;
    p.region = p.solid = 0;
    p.depth = p.partitions = p.overlap = 0;
    return p;
}

// Region `region` where the ray comes upon it at the end `seen`. If the region begins where another solid ends
// (`from_within`), that solid's surface is seen from within: the normal is flipped. Only here is a normal computed: one a ray.
FN Pixel seen_pixel(GLOBAL const Frame* f, GLOBAL const LightRecord* lights, MaterialRecord m, Geometry g, ray3 r, End seen,
                    u32 from_within, u32 region) {
    vec3 n = normal_at(g, g.solids[seen.solid], r, seen.t, seen.surface);
    Pixel p;
    if (from_within) n = scale(n, REAL(-1));
    p = hit_pixel(f, lights, m, r, seen.t, n);
    p.region = region + 1;
    p.solid = seen.solid + 1;
    return p;
}

// Stores what is seen of the tile's ray `id`, channel by channel.
FN void put_pixel(GLOBAL const Frame* f, GLOBAL float* picture, u32 id, Pixel p) {
    const size_t size = f->ray_count;
    u32 i;
    picture += id;
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
