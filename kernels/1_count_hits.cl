// Kernel 1: how many segments does each ray have, so that exactly that much memory is allocated.
// The counts are then summed (scan.cl): each ray's own place in the buffers of the later kernels.
#include "camera.h"
#include "traverse.h"

__kernel void count_hits(__global const Frame* frame, __global const SolidRecord* solids, __global const real* reals,
                         __global const PlaneRecord* planes, __global const PlaneRef* plane_refs,
                         __global const BvhNode* nodes, __global const RayRecord* rays, __global RayCount* counts) {
    u32 id = (u32)get_global_id(0);
    Geometry g;
    RayCount count;
    ray3 r;
    if (id >= frame->ray_count) return;
    g.solids = solids;
    g.reals = reals;
    g.planes = planes;
    g.plane_refs = plane_refs;
    count.segments = count.words = count.regions = 0;
    if (ray_of(frame, rays, frame->first_ray + id, &r)) {
        walk_state w = walk(frame, g, nodes, r, 0);
        u32 words = words_of(w.segments);
        u32 partitions = partitions_of(w.segments);
        count.segments = w.segments;
        count.words = words && partitions > COUNT_MAX / words ? COUNT_MAX : partitions * words;
        count.regions = w.regions;
    }
    counts[id] = count;
}
