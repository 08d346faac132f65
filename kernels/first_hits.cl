// The first hits of a picture, in two kernels and without segments in memory: which blocks of pixels can see anything at
// all; then each of their rays on its own, from its walk to its pixel.
#include "first_hit.h"
#include "geometry/solid.h"
#include "shading.h"

// How far the rays of a block are from the ray through its middle, at most, within the scene's sphere.
static real block_spread(GLOBAL const Frame* f) {
    wide3 u = make_wide3(f->u[0], f->u[1], f->u[2]), v = make_wide3(f->v[0], f->v[1], f->v[2]);
    wide3 w = make_wide3(f->w[0], f->w[1], f->w[2]);
    wide across = (wide)(BLOCK / 2) * (wide_sqrt(wide_dot(u, u)) + wide_sqrt(wide_dot(v, v)));
    if (f->perspective) {
        wide3 to = wide_subtract(frame_center(f), make_wide3(f->eye[0], f->eye[1], f->eye[2]));
        across = across * (wide_sqrt(wide_dot(to, to)) + f->radius) / wide_sqrt(wide_dot(w, w));
    }
    return REAL(across) * REAL(1.001);
}

// A work-item is a block: 1 if one of its rays may meet a solid.
__kernel void cull_blocks(__global const Frame* frame, __global const BvhNode* nodes, __global unsigned char* blocks) {
    u32 id = (u32)get_global_id(0), i = 0, met = frame->unbounded_count > 0;
    pixel_position at;
    if (id >= frame->ray_count / (BLOCK * BLOCK)) return;
    at = pixel_of(frame->first_ray + id * BLOCK * BLOCK, frame->width, frame->height);
    at.x += BLOCK / 2;
    at.y += BLOCK / 2;
    if (!met) {
        ray3 r = geometry_ray(frame, camera_ray(frame, at));
        real spread = block_spread(frame), reach = REAL(frame->radius) + spread;
        slab_ray s = make_slab_ray(offset_from(frame_center(frame), r.o), r.d, reach, t_min_along(frame, r));
        float pad = (float)(spread + reach * REAL(0x1p-19));
        while (s.hits_sphere && !met && i < frame->node_count) {
            BvhNode node = nodes[i];
            u32 k, hit;
            for (k = 0; k < 3; ++k) {
                node.low[k] = node.low[k] - pad;
                node.high[k] = node.high[k] + pad;
            }
            hit = box_is_hit(s, node);
            met = hit && node.leaf;
            i = hit ? i + 1 : node.skip;
        }
    }
    blocks[id] = (unsigned char)met;
}

__kernel void first_hits(__global const Frame* frame, __global const SolidRecord* solids, __global const real* reals,
                         __global const PlaneRecord* planes, __global const PlaneRef* plane_refs, __global const u32* words,
                         __global const BvhNode* inner_nodes, __global const BvhNode* nodes,
                         __global const RegionRecord* regions, __global const StartRecord* starts, __global const u32* leaves,
                         __global const u32* trees, __global const MaterialRecord* materials,
                         __global const LightRecord* lights, __global const unsigned char* blocks,
                         __global u32* overflows, __global u32* overflown, __global float* picture) {
    u32 id = (u32)get_global_id(0);
    pixel_position at;
    Pixel pixel;
    if (id >= frame->ray_count) return;
    at = pixel_of(frame->first_ray + id, frame->width, frame->height);
    if (!at.inside) return;
    pixel = background_pixel(frame);
    if (blocks[id / (BLOCK * BLOCK)]) {
        scene_tables s;
        front w;
        ray3 r = geometry_ray(frame, camera_ray(frame, at));
        int found;
        s.g = make_geometry(solids, reals, planes, plane_refs, words, inner_nodes);
        s.nodes = nodes;
        s.starts = starts;
        s.leaves = leaves;
        s.trees = trees;
        found = first_hit(frame, s, r, &w);
        if (found == RAY_OVERFLOWS) {
            u32 place = atomic_inc(overflows);
            overflown[place] = frame->first_ray + id;
            return;
        }
        if (found == RAY_HITS) {
            vec3 n = normal_at(s.g, solids[w.seen.solid], r, w.seen.t, w.seen.surface);
            if (w.from_within) n = scale(n, REAL(-1));
            pixel = hit_pixel(frame, lights, materials[regions[w.region].material], r, w.seen.t, n);
            pixel.region = w.region + 1;
            pixel.solid = w.seen.solid + 1;
        }
    }
    put_pixel(frame, picture, at, pixel);
}
