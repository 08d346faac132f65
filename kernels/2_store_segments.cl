// Kernel 2: stores the two boundaries of each segment in the ray's part of `boundaries`. There is a work-item for each
// candidate, as in kernel 1. It copies the candidate's only segment, which kernel 1 kept, or intersects the solid again
// if there are several segments.
//
//   boundaries of a ray:   in out | in out | in out ...      by ascending solid, then by distance
//
// The number of a boundary's ray is stored in the boundary's word of `bits` until kernel 3 has read it. It cannot be
// stored in the boundary's node: the nodes may lie in the same memory as `found`.
#include "traversal/camera.h"
#include "shared/capacity.h"
#include "shared/scene_args.h"
#include "geometry/collect.h"

static void store(__global const Frame* frame, Geometry g, __global const RayRecord* rays, __global const u32* listed,
                  Candidate c, __global const Boundary* found, __global const RayCount* offsets,
                  __global Boundary* boundaries, __global u32* bits) {
    const size_t base = 2 * ((size_t)offsets[c.ray].segments + c.before);
    u32 i;
    if (c.count == 0 || c.count & IN_SOME_FACE) return;
#if (CSGRT_SOLIDS) & ~ONE_SEGMENT
    if (c.count > 1 || (MANY_SEGMENTS >> g.solids[c.solid].type & 1u)) {
        ray3 r;
        ray_range wanted;
        u32 near = 0;  // not read: kernel 1 has marked the candidates in faces
        if (!ray_of(frame, rays, number_of(frame, listed, c.ray), &r, &wanted)) return;
        collect_as_it_is(g, g.solids[c.solid], c.solid, r, wanted.t_min, boundaries + base, &near);
    } else
#endif
    {
        boundaries[base] = found[0];
        boundaries[base + 1] = found[1];
    }
    for (i = 0; i < 2 * c.count; ++i) bits[base + i] = c.ray;
}

__kernel void store_segments(__global const Frame* frame, GEOMETRY_ARGS, __global const RayRecord* rays,
                             __global const u32* listed, __global const CandidateCount* places,
                             __global const Candidate* candidates, __global const Boundary* found,
                             __global const RayCount* offsets, __global Boundary* boundaries, __global u32* bits) {
    const u32 id = (u32)get_global_id(0);
    if (segments_fit(frame, offsets) && id < candidates_of(frame, places))
        store(frame, GEOMETRY, rays, listed, candidates[id], found + 2 * (size_t)id, offsets, boundaries, bits);
}
