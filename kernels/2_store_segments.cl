// Kernel 2: the same walk again; each segment's two ends go to the ray's own place.
//
//   ends of a ray:   in out | in out | in out ...      by ascending solid, then by distance
#include "camera.h"
#include "traverse.h"

__kernel void store_segments(__global const Frame* frame, __global const SolidRecord* solids, __global const real* reals,
                             __global const PlaneRecord* planes, __global const PlaneRef* plane_refs, __global const u32* words,
                             __global const BvhNode* inner_nodes,
                             __global const BvhNode* nodes, __global const RayRecord* rays,
                             __global const RayCount* offsets, __global End* ends) {
    u32 id = (u32)get_global_id(0);
    Geometry g = make_geometry(solids, reals, planes, plane_refs, words, inner_nodes);
    ray3 r;
    if (id >= frame->ray_count) return;
    if (offsets[id].segments == offsets[id + 1].segments) return;
    if (ray_of(frame, rays, number_of(frame, rays, id), &r)) walk(frame, g, nodes, r, ends + 2 * (size_t)offsets[id].segments);
}
