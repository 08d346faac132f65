// Kernel 4: finds the region that claims each partition. Each node has its own work-item, so that no partition waits
// for the partitions before it.
//
// Of regions that overlap, the region of the smallest index owns the partition. Regions are numbered as BRL-CAD ranks
// them: solids come before FASTGEN's plates, plates before its volumes, and air comes last; regions of one rank come in
// the model's order. A rule that looked at the partition before would depend on the ray's direction.
#include "boolean/claim.h"
#include "geometry/beyond.h"
#include "traversal/camera.h"
#include "shared/capacity.h"
#include "shared/scene_args.h"

// Returns PartitionNode.owner for node `id`. `c` comes with the scene's tables and the ray's `beyond`; its other
// members are set here.
static u32 owner_of(__global const u32* ranks, cover c, u32 id, u32 ray, __global const RayCount* offsets,
                    __global const Boundary* all_boundaries, __global const u32* all_bits) {
    const RayCount offset = offsets[ray];
    covered_solids covered;
    u32 owner = ALONE_UNKNOWN;
    c.missed = 0;
    c.marked = 1;
    c.segments = offsets[ray + 1].segments - offset.segments;
    c.boundaries = all_boundaries + 2 * (size_t)offset.segments;
    c.bits = all_bits + offset.words + (id - 2 * offset.segments) * words_of(c.segments);
    list_covered(c, &covered);
    if (covered.count == 1 && !c.beyond) owner = c.solids[covered.solids[0]].alone;
    if (owner == ALONE_UNKNOWN) {
        const claim found = find_claim_beside(c, c.bits, &covered, ranks, all_solids());
        owner = found.least | (found.other != NONE ? OVERLAP : 0u);
    }
    return owner;
}

__kernel void evaluate(__global const Frame* frame, EVALUATION_ARGS, __global const RayRecord* rays,
                       __global const u32* listed, __global const RayCount* offsets,
                       __global const Boundary* all_boundaries, __global const u32* all_bits,
                       __global PartitionNode* nodes) {
    const u32 id = (u32)get_global_id(0);
    u32 ray;
    cover c;
    if (id >= 2 * segments_of(frame, offsets) || nodes[id].in_boundary == NONE) return;
    ray = nodes[id].owner;
    if (offsets[ray + 1].segments - offsets[ray].segments > DEEP_SEGMENTS) return;
    c.solids = solids;
    c.starts = starts;
    c.trees = trees;
    c.beyond = 0;
    if (frame->clip_count) {
        ray3 r;
        ray_range wanted;
        if (ray_of(frame, rays, number_of(frame, listed, ray), &r, &wanted)) c.beyond = sides_beyond(frame, r);
    }
    nodes[id].owner = owner_of(frame->rank_ends, c, id, ray, offsets, all_boundaries, all_bits);
}
