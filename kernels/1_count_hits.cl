// Kernel 1: how many segments does each ray have, so that exactly that much memory is allocated.
// The counts are then summed (scan.cl): each ray's own place in the buffers of the later kernels.
#include "camera.h"
#include "traverse.h"

__kernel void count_hits(__global const Frame* frame, __global const SolidRecord* solids, __global const real* reals,
                         __global const PlaneRecord* planes, __global const PlaneRef* plane_refs, __global const u32* words,
                         __global const BvhNode* inner_nodes,
                         __global const BvhNode* nodes, __global const RayRecord* rays, __global RayCount* counts) {
    u32 id = (u32)get_global_id(0);
    Geometry g = make_geometry(solids, reals, planes, plane_refs, words, inner_nodes);
    RayCount count;
    ray3 r;
    if (id >= frame->ray_count) return;
    count.segments = count.words = 0;
    if (ray_of(frame, rays, number_of(frame, rays, id), &r)) {
        walk_state w = walk(frame, g, nodes, r, 0);
        count.segments = w.segments;
        // 2 n x n / 32 passes 2^32 from n = 2^18 on.
        count.words = w.segments < (1u << 18) ? partitions_of(w.segments) * words_of(w.segments) : COUNT_MAX;
    }
    counts[id] = count;
}
