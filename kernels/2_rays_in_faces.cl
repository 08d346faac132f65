// Kernels 1 and 2 for candidates whose ray may run in a face of the solid: kernel 1 has marked them (IN_SOME_FACE).
// Such rays are rare but costly: within kernels 1 and 2 their work would slow down all other rays of a GPU (measured:
// docs/experiments.md). A program has these kernels if its scene has solids of the types FLAT_FACED.
#include "traversal/camera.h"
#include "shared/capacity.h"
#include "shared/scene_args.h"
#include "geometry/collect.h"

// Counts the segments of marked candidates, after count_segments. The marks stay.
__kernel void count_in_faces(__global const Frame* frame, GEOMETRY_ARGS, __global const RayRecord* rays,
                             __global const u32* listed, __global const CandidateCount* places,
                             __global Candidate* candidates) {
    const u32 id = (u32)get_global_id(0);
    const Geometry g = GEOMETRY;
    Candidate c;
    ray3 r;
    ray_range wanted;
    if (id >= candidates_of(frame, places)) return;
    c = candidates[id];
    if (!(c.count & IN_SOME_FACE) || !ray_of(frame, rays, number_of(frame, listed, c.ray), &r, &wanted)) return;
    c.count = collect_beside(g, g.solids[c.solid], c.solid, r, wanted.t_min, 0, c.count & ~IN_SOME_FACE);
    candidates[id].count = c.count | IN_SOME_FACE;
}

// Stores the segments of marked candidates, after store_segments.
__kernel void store_in_faces(__global const Frame* frame, GEOMETRY_ARGS, __global const RayRecord* rays,
                             __global const u32* listed, __global const CandidateCount* places,
                             __global const Candidate* candidates, __global const RayCount* offsets,
                             __global Boundary* boundaries, __global u32* bits) {
    const u32 id = (u32)get_global_id(0);
    const Geometry g = GEOMETRY;
    Candidate c;
    ray3 r;
    ray_range wanted;
    size_t base;
    u32 i;
    if (!segments_fit(frame, offsets) || id >= candidates_of(frame, places)) return;
    c = candidates[id];
    if (!(c.count & IN_SOME_FACE) || !ray_of(frame, rays, number_of(frame, listed, c.ray), &r, &wanted)) return;
    base = 2 * ((size_t)offsets[c.ray].segments + c.before);
    collect(g, g.solids[c.solid], c.solid, r, wanted.t_min, boundaries + base);
    for (i = 0; i < 2 * (c.count & ~IN_SOME_FACE); ++i) bits[base + i] = c.ray;
}
