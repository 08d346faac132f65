// Kernel 2: a work-item for each candidate again; each segment's two ends go to the ray's own place. A candidate's only
// segment was kept by kernel 1, several are found again.
//
//   ends of a ray:   in out | in out | in out ...      by ascending solid, then by distance
//
// Whose an end is stands in the end's word of `bits` until kernel 3 has read it: the nodes may lie where `found` does.
#include "traversal/camera.h"
#include "shared/capacity.h"
#include "shared/scene_args.h"
#include "geometry/collect.h"

static void store(__global const Frame* frame, Geometry g, __global const RayRecord* rays, __global const u32* listed, Candidate c, __global const End* found,
                  __global const RayCount* offsets, __global End* ends, __global u32* bits) {
    const size_t base = 2 * ((size_t)offsets[c.ray].segments + c.before);
    u32 i;
    if (c.count == 0) return;
#if (CSGRT_SOLIDS) & ~ONE_SEGMENT
    if (c.count > 1 || (MANY_SEGMENTS >> g.solids[c.solid].type & 1u)) {
        ray3 r;
        if (!ray_of(frame, rays, number_of(frame, listed, c.ray), &r)) return;
        collect(g, g.solids[c.solid], c.solid, r, t_min_along(frame, r), ends + base);
    } else
#endif
    {
        ends[base] = found[0];
        ends[base + 1] = found[1];
    }
    for (i = 0; i < 2 * c.count; ++i) bits[base + i] = c.ray;
}

__kernel void store_segments(__global const Frame* frame, GEOMETRY_ARGS, __global const RayRecord* rays, __global const u32* listed, __global const RayCount* places,
                             __global const Candidate* candidates, __global const End* found,
                             __global const RayCount* offsets, __global End* ends, __global u32* bits) {
    const u32 id = (u32)get_global_id(0);
    if (segments_fit(frame, offsets) && id < candidates_of(frame, places))
        store(frame, GEOMETRY, rays, listed, candidates[id],
              found + 2 * (size_t)id, offsets, ends, bits);
}
