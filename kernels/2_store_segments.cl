// Kernel 2: a work-item for each candidate again; each segment's two ends go to the ray's own place.
//
//   ends of a ray:   in out | in out | in out ...      by ascending solid, then by distance
#include "camera.h"
#include "geometry/collect.h"

__kernel void store_segments(__global const Frame* frame, __global const SolidRecord* solids, __global const real* reals,
                             __global const PlaneRecord* planes, __global const PlaneRef* plane_refs, __global const u32* words,
                             __global const BvhNode* inner_nodes, __global const RayRecord* rays, u32 size,
                             __global const Candidate* candidates, __global const RayCount* offsets, __global End* ends,
                             __global PartitionNode* nodes) {
    u32 id = (u32)get_global_id(0), i;
    size_t base;
    Geometry g = make_geometry(solids, reals, planes, plane_refs, words, inner_nodes);
    Candidate c;
    ray3 r;
    if (id >= size) return;
    c = candidates[id];
    if (c.count == 0 || !ray_of(frame, rays, number_of(frame, rays, c.ray), &r)) return;
    base = 2 * ((size_t)offsets[c.ray].segments + c.before);
    collect(g, solids[c.solid], c.solid, r, t_min_along(frame, r), ends + base);
    for (i = 0; i < 2 * c.count; ++i) nodes[base + i].ray = c.ray;
}
