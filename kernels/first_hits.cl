// The first hits of a picture, without segments in memory: from a tile's nodes to its pixels. How a work-item goes that way
// comes before this: a ray at a time (shading/first_hits_ray.h), or on processors eight (packet/first_hits_packet.h).
//
// Of a batch whose pixels come by lines the host need not know how many tiles see anything: items without an entry end at once.

// The number that item `id` has by the list of tiles, see PART_SHIFT. COUNT_MAX, which no ray of a picture has: it has none.
FN u32 number_in_part(__global const u32* entries, u32 id) {
    const u32 entry = entries[id / (TILE * TILE)], code = entry >> PART_SHIFT, within = id % (TILE * TILE);
    const u32 parts = code ? PARTS : 1u, rays = LOCKSTEP / parts, part = code ? code - PARTS : 0;
    if (within % LOCKSTEP >= rays) return COUNT_MAX;
    return (entry & ((1u << PART_SHIFT) - 1u)) * (TILE * TILE) + part * (TILE * TILE) / parts + within / LOCKSTEP * rays +
           within % LOCKSTEP;
}

#include "shared/scene_args.h"

__kernel void first_hits(__global const Frame* frame, GEOMETRY_ARGS, __global const BvhNode* nodes, REGION_ARGS, APPEARANCE_ARGS,
                         __global const TileNode* tile_nodes, __global const u32* listed, __global BatchReport* report,
                         __global u32* overflown, __global float* picture) {
    const u32 id = (u32)get_global_id(0) * RAYS_AN_ITEM;
    u32 number, lost, sees;
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
    lost = draw(frame, s, a, list_of(frame, tile_nodes, number), at, picture + place_of(frame, at, FIRST_OF_ITEM(id)), &sees);
    if (sees) mark_shown(frame, report, number);
    for (; lost; lost &= lost - 1u) overflown[atomic_inc(&report->overflows)] = number + RAY_OF_ITEM(lowest(lost));
}
