// Pixels: computes the channels of a packet's pixels from the first hits of its rays, as shading/pixel.h does for one
// ray.
#ifndef CSGRT_PACKET_PIXELS_H
#define CSGRT_PACKET_PIXELS_H

#include "hits.h"
#include "../shading/pixel.h"

// Vectors along the outward normals at the first hits of the rays of the hit mask. Each other ray gets the normal of
// the first ray of the mask.
FN packet_vec3 seen_normals(const packet* p, Geometry g, u32 hit_mask, double8 t) {
    real x[PACKET], y[PACKET], z[PACKET];
    packet_vec3 n;
    u32 rest = hit_mask, k;
    while (rest) {
        const u32 first = lowest(rest);
        const Boundary seen = p->sweeps[first].seen;
        const SolidRecord solid = g.solids[seen.solid];
        u32 same = 0;
        for (k = first; k < PACKET; ++k) {
            const Boundary other = p->sweeps[k].seen;
            same |= other.solid == seen.solid && other.surface == seen.surface ? 1u << k & rest : 0;
        }
        if (!takes_packets(solid)) same = 1u << first;
        if ((same & (same - 1u)) && packet_normals(g, solid, p->rays, t, seen.surface, &n)) {
            real nx[PACKET], ny[PACKET], nz[PACKET];
            vstore8(n.x, 0, nx);
            vstore8(n.y, 0, ny);
            vstore8(n.z, 0, nz);
            for (k = first; k < PACKET; ++k)
                if (same >> k & 1u) {
                    x[k] = nx[k];
                    y[k] = ny[k];
                    z[k] = nz[k];
                }
        } else {
            const vec3 one = normal_of_any_length(g, solid, lane(&p->lanes, first), seen.t, seen.surface);
            for (k = first; k < PACKET; ++k)
                if (same >> k & 1u) {
                    x[k] = one.x;
                    y[k] = one.y;
                    z[k] = one.z;
                }
        }
        rest &= ~same;
    }
    for (k = 0; k < PACKET; ++k)
        if (!(hit_mask >> k & 1u)) {
            x[k] = x[lowest(hit_mask)];
            y[k] = y[lowest(hit_mask)];
            z[k] = z[lowest(hit_mask)];
        }
    n.x = vload8(0, x);
    n.y = vload8(0, y);
    n.z = vload8(0, z);
    return n;
}

// Stores a channel's values. `channel`: the first pixel's position; the second row's is `line` floats further.
FN void put_channel(__global float* channel, u32 line, u32 active_mask, float8 values) {
    if (active_mask == 0xff) {
        vstore4(values.lo, 0, channel);
        vstore4(values.hi, 0, channel + line);
    } else {
        float one[PACKET];
        vstore8(values, 0, one);
        for (; active_mask; active_mask &= active_mask - 1u) {
            const u32 k = lowest(active_mask);
            channel[k / PACKET_ROW * line + k % PACKET_ROW] = one[k];
        }
    }
}

FN void put_words(__global float* channel, u32 line, u32 active_mask, u32 hit_mask, const u32* words, u32 background) {
    u32 k;
    for (k = 0; k < PACKET; ++k)
        if (active_mask >> k & 1u)
            ((__global u32*)channel)[k / PACKET_ROW * line + k % PACKET_ROW] =
                hit_mask >> k & 1u ? words[k] : background;
}

// The sights of the rays of the hit mask, in which at least one bit is set. Each other ray gets the sight of the first
// ray of the mask.
typedef struct {
    packet_sight sight;
    u32 region[PACKET], solid[PACKET];  // number + 1; 0: none
} packet_view;

FN packet_view view_of(const packet* p, __global const Frame* f, Geometry g, appearance_tables a, u32 hit_mask) {
    real red[PACKET], green[PACKET], blue[PACKET], specular[PACKET], diffuse[PACKET], ambient[PACKET], glow[PACKET],
        t[PACKET];
    ulong shine[PACKET];
    u32 within = 0, k;
    long8 flipped, is_cut;
    double8 at;
    packet_finish finish;
    packet_vec3 n;
    packet_view view;
    for (k = 0; k < PACKET; ++k) {
        const sweep* w = p->sweeps + (hit_mask >> k & 1u ? k : lowest(hit_mask));
        const MaterialRecord m = a.materials[w->region];
        t[k] = w->seen.t;
        view.region[k] = hit_mask >> k & 1u ? w->region + 1 : 0;
        view.solid[k] = hit_mask >> k & 1u ? w->seen.solid + 1 : 0;
        within |= w->from_within ? 1u << k : 0;
        red[k] = m.r;
        green[k] = m.g;
        blue[k] = m.b;
        specular[k] = m.specular;
        diffuse[k] = m.diffuse;
        ambient[k] = m.ambient;
        glow[k] = m.glow;
        shine[k] = m.shine;
    }
    finish.color.r = vload8(0, red);
    finish.color.g = vload8(0, green);
    finish.color.b = vload8(0, blue);
    finish.specular = vload8(0, specular);
    finish.diffuse = vload8(0, diffuse);
    finish.ambient = vload8(0, ambient);
    finish.glow = vload8(0, glow);
    finish.shine = vload8(0, shine);
    at = vload8(0, t);
    n = unit_or_against(seen_normals(p, g, hit_mask, at), p->rays.d);
    flipped = convert_long8(of_bits(within));
    n.x = flipped ? -n.x : n.x;
    n.y = flipped ? -n.y : n.y;
    n.z = flipped ? -n.z : n.z;
    is_cut = at < p->range.near && p->range.plane != NO_PLANE;
    if (f->clip_count && any(is_cut)) {
        const u32 cut_mask = bits_of(is_cut);
        at = is_cut ? p->range.near : at;
        for (k = 0; k < f->clip_count; ++k) {
            const long8 is_plane = is_cut && p->range.plane == k;
            n.x = is_plane ? (double8)f->clip[k].nx : n.x;
            n.y = is_plane ? (double8)f->clip[k].ny : n.y;
            n.z = is_plane ? (double8)f->clip[k].nz : n.z;
        }
        for (k = 0; k < PACKET; ++k) view.solid[k] = cut_mask >> k & 1u ? 0 : view.solid[k];
    }
    view.sight = shade_plastic(f, a.lights, finish, p->rays, at, n, p->range.near);
    return view;
}

// Stores the pixels of the active rays; the rays of the hit mask see something. The function is not inlined, which is
// faster (docs/experiments.md).
NOINLINE_FN void put_pixels(const packet* p, __global const Frame* f, Geometry g, appearance_tables a,
                            __global float* picture, u32 active_mask, u32 hit_mask) {
    const size_t size = channel_size(f);
    const u32 line = f->rows ? width_of(f->screen) : TILE;
    const int8 is_hit = of_bits(hit_mask);
    packet_view v;
    u32 k;
    if (hit_mask) v = view_of(p, f, g, a, hit_mask);
#define PUT(value, background) \
    put_channel(picture, line, active_mask, is_hit ? value : (float8)(background)), picture += size
    if (f->channels & CHANNEL_COLOR) {
        PUT(convert_float8(v.sight.color.r), f->background[0]);
        PUT(convert_float8(v.sight.color.g), f->background[1]);
        PUT(convert_float8(v.sight.color.b), f->background[2]);
        PUT((float8)(1), f->background[3]);
    }
    if (f->channels & CHANNEL_DISTANCE) PUT(convert_float8(v.sight.t), (float)REAL_INFINITY);
    if (f->channels & CHANNEL_NORMAL) {
        PUT(convert_float8(v.sight.n.x), 0);
        PUT(convert_float8(v.sight.n.y), 0);
        PUT(convert_float8(v.sight.n.z), 0);
    }
    if (f->channels & CHANNEL_IDS) {
        put_words(picture, line, active_mask, hit_mask, v.region, 0);
        put_words(picture + size, line, active_mask, hit_mask, v.solid, 0);
        picture += 2 * size;
    }
    if (f->channels & CHANNEL_COUNTS)
        for (k = 0; k < 3; ++k) PUT((float8)(0), 0);
#undef PUT
    if (f->channels & CHANNEL_DISPLAY) {
        GLOBAL const float* const b = f->background;
        float red[PACKET], green[PACKET], blue[PACKET];
        u32 words[PACKET];
        if (hit_mask) {
            vstore8(convert_float8(v.sight.color.r), 0, red);
            vstore8(convert_float8(v.sight.color.g), 0, green);
            vstore8(convert_float8(v.sight.color.b), 0, blue);
        }
        for (k = 0; k < PACKET; ++k)
            words[k] = hit_mask >> k & 1u ? display_word(a.display, red[k], green[k], blue[k], 1) : 0;
        put_words(picture, line, active_mask, hit_mask, words, display_word(a.display, b[0], b[1], b[2], b[3]));
    }
}

#endif
