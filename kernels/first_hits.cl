// Draws the first hits of a picture in one kernel, from a tile's list of nodes to its pixels, without segments in
// global memory. The header that is compiled before this file says what a work-item draws: one ray
// (shading/first_hits_ray.h), or on processors a packet of eight (packet/first_hits_packet.h).
//
// For a batch whose picture is row-major the host launches a work-item for each ray of all tiles, before it knows how
// many tiles the list has. Work-items behind the list's last entry return at once.

// The number of the ray of work-item `id`, by the list of tiles (PART_SHIFT). COUNT_MAX, which no ray of a picture has:
// the work-item has no ray.
FN u32 number_in_part(__global const u32* entries, u32 id) {
    const u32 entry = entries[id / (TILE * TILE)], code = entry >> PART_SHIFT, within = id % (TILE * TILE);
    const u32 parts = code ? PARTS : 1u, rays = ASSUMED_WARP / parts, part = code ? code - PARTS : 0;
    if (within % ASSUMED_WARP >= rays) return COUNT_MAX;
    return (entry & ((1u << PART_SHIFT) - 1u)) * (TILE * TILE) + part * (TILE * TILE) / parts +
           within / ASSUMED_WARP * rays + within % ASSUMED_WARP;
}

#include "shared/scene_args.h"

__kernel void first_hits(__global const Frame* frame, GEOMETRY_ARGS, __global const BvhNode* nodes, REGION_ARGS,
                         APPEARANCE_ARGS, __global const TileNode* tile_nodes, __global const u32* listed,
                         __global BatchReport* report, __global u32* overflown, __global float* picture) {
    const u32 id = (u32)get_global_id(0) * RAYS_AN_ITEM;
    u32 number, overflow_mask, hit_mask;
    pixel_position at;
    scene_tables s;
    appearance_tables a;
    if (id >= frame->ray_count || (frame->rows && id / (TILE * TILE) >= report->entries)) return;
    number = frame->rows ? number_in_part(listed, id) : number_of(frame, listed, id);
    if (number == COUNT_MAX) return;
    number = FIRST_OF_ITEM(number);
    at = pixel_of(number, frame->screen);
    if (!at.inside) return;
    s.g = GEOMETRY;
    s.nodes = nodes;
    s.starts = starts;
    s.trees = trees;
#if SHAPED_LIGHTS
    s.seen_end = frame->rank_ends[RANK_AIR];
#endif
    a.materials = materials;
    a.lights = lights;
    a.display = display;
    overflow_mask = draw(frame, s, a, list_of(frame, tile_nodes, number), at,
                         picture + place_of(frame, at, FIRST_OF_ITEM(id)), &hit_mask);
    if (hit_mask) mark_shown(frame, report, number);
    for (; overflow_mask; overflow_mask &= overflow_mask - 1u)
        overflown[atomic_inc(&report->overflows)] = number + RAY_OF_ITEM(lowest(overflow_mask));
}
