// The first hits of a picture, without segments in memory: each ray on its own, from its block's nodes to its pixel.
#include "first_hit.h"
#include "shading.h"

__kernel void first_hits(__global const Frame* frame, __global const SolidRecord* solids, __global const real* reals,
                         __global const PlaneRecord* planes, __global const PlaneRef* plane_refs, __global const u32* words,
                         __global const BvhNode* inner_nodes, __global const BvhNode* nodes,
                         __global const RegionRecord* regions, __global const StartRecord* starts, __global const u32* leaves,
                         __global const u32* trees, __global const MaterialRecord* materials,
                         __global const LightRecord* lights, __global const BlockNode* block_nodes,
                         __global const RayRecord* rays,
                         __global u32* overflows, __global u32* overflown, __global float* picture) {
    u32 id = (u32)get_global_id(0), number, found;
    pixel_position at;
    Pixel pixel;
    scene_tables s;
    front w;
    ray3 r;
    if (id >= frame->ray_count) return;
    number = number_of(frame, rays, id);
    at = pixel_of(number, frame->width, frame->height);
    if (!at.inside) return;
    r = geometry_ray(frame, camera_ray(frame, at));
    s.g = make_geometry(solids, reals, planes, plane_refs, words, inner_nodes);
    s.nodes = nodes;
    s.starts = starts;
    s.leaves = leaves;
    s.trees = trees;
    found = first_hit(frame, s, list_of(frame, block_nodes, number), r, &w);
    if (found == RAY_OVERFLOWS) {
        u32 place = atomic_inc(overflows);
        overflown[place] = number;
        return;
    }
    if (found == RAY_HITS) {
        const MaterialRecord material = materials[regions[w.region].material];
        pixel = seen_pixel(frame, lights, material, s.g, r, w.seen, w.from_within, w.region);
    } else {
        pixel = background_pixel(frame);
    }
    put_pixel(frame, picture, id, pixel);
}
