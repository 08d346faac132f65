// Kernel 1: how many segments does each ray have, so that exactly that much memory is allocated. First in float, from box
// to box: which solids may the ray meet. Then a work-item for each such candidate, so that no ray waits for its many solids
// one after the other.
//
//   find candidates -> (scan) -> list candidates -> count hits -> sum hits -> (scan)
#include "camera.h"
#include "geometry/collect.h"
#include "traverse.h"

__kernel void find_candidates(__global const Frame* frame, __global const BvhNode* nodes, __global const RayRecord* rays,
                              __global RayCount* counts) {
    u32 id = (u32)get_global_id(0);
    RayCount count;
    ray3 r;
    if (id >= frame->ray_count) return;
    count.segments = count.words = 0;
    if (ray_of(frame, rays, number_of(frame, rays, id), &r)) count.segments = walk(frame, nodes, r, id, 0);
    counts[id] = count;
}

__kernel void list_candidates(__global const Frame* frame, __global const BvhNode* nodes, __global const RayRecord* rays,
                              __global const RayCount* places, __global Candidate* candidates) {
    u32 id = (u32)get_global_id(0);
    ray3 r;
    if (id >= frame->ray_count || places[id].segments == places[id + 1].segments) return;
    if (ray_of(frame, rays, number_of(frame, rays, id), &r)) walk(frame, nodes, r, id, candidates + places[id].segments);
}

__kernel void count_hits(__global const Frame* frame, __global const SolidRecord* solids, __global const real* reals,
                         __global const PlaneRecord* planes, __global const PlaneRef* plane_refs, __global const u32* words,
                         __global const BvhNode* inner_nodes, __global const RayRecord* rays, u32 size,
                         __global Candidate* candidates) {
    u32 id = (u32)get_global_id(0);
    Geometry g = make_geometry(solids, reals, planes, plane_refs, words, inner_nodes);
    Candidate c;
    ray3 r;
    if (id >= size) return;
    c = candidates[id];
    if (ray_of(frame, rays, number_of(frame, rays, c.ray), &r))
        candidates[id].count = collect(g, solids[c.solid], c.solid, r, t_min_along(frame, r), 0);
}

// Each ray's counts, and each of its candidates' place among the ray's segments.
__kernel void sum_hits(__global const Frame* frame, __global const RayCount* places, __global Candidate* candidates,
                       __global RayCount* counts) {
    u32 id = (u32)get_global_id(0), i;
    RayCount count;
    if (id >= frame->ray_count) return;
    count.segments = 0;
    for (i = places[id].segments; i < places[id + 1].segments; ++i) {
        candidates[i].before = count.segments;
        count.segments += candidates[i].count;
    }
    // 2 n x n / 32 passes 2^32 from n = 2^18 on.
    count.words = count.segments < (1u << 18) ? partitions_of(count.segments) * words_of(count.segments) : COUNT_MAX;
    counts[id] = count;
}
