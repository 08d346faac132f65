// Kernel 1: counts each ray's segments. Then the host allocates exactly the memory that the segments need, or the next
// kernels check whether the existing buffers suffice (shared/capacity.h). First each ray walks the hierarchy, in float,
// and lists its candidates: the solids that it may meet. Then a work-item intersects each candidate, so that no ray
// waits for its many solids one after the other.
//
//   find candidates -> (scan) -> find candidates, listing them -> count segments -> sum segments -> (scan)
//
// A candidate whose ray may run in a face of its solid is counted once more before the sum (2_rays_in_faces.cl). On
// processors, packets of eight rays list the candidates of a picture's tiles (1_packet_candidates.cl).
#include "traversal/beam.h"
#include "traversal/camera.h"
#include "geometry/collect.h"
#include "shared/capacity.h"
#include "shared/scene_args.h"
#include "traversal/candidates.h"

// Runs twice: first it counts each ray's candidates (`candidates` is 0), then it lists them from the ray's offset in
// `places` on. `lists`: kernel 0's lists, or 0 if the rays do not come in tiles.
__kernel void find_candidates(__global const Frame* frame, __global const BvhNode* nodes,
                              __global const TileNode* lists, __global const RayRecord* rays,
                              __global const u32* listed, __global CandidateCount* places,
                              __global Candidate* candidates) {
    u32 id = (u32)get_global_id(0), number;
    CandidateCount count;
    ray3 r;
    ray_range wanted;
    if (id >= frame->ray_count) return;
    if (candidates) {
        if (places[id].candidates == places[id + 1].candidates || !candidates_of(frame, places)) return;
        candidates += places[id].candidates;
    }
    count.candidates = count.unused = 0;
    number = number_of(frame, listed, id);
    if (lists) lists = list_of(frame, lists, number);
    if (ray_of(frame, rays, number, &r, &wanted))
        count.candidates = walk(frame, nodes, lists, r, wanted, id, candidates);
    if (!candidates) places[id] = count;
}

static void intersect_candidate(__global const Frame* frame, Geometry g, __global const RayRecord* rays,
                                __global const u32* listed, __global Candidate* candidate, __global Boundary* segment) {
    const Candidate c = *candidate;
    SolidRecord solid;
    ray3 r, own;
    ray_range wanted;
    u32 count, near = 0;
#ifdef CSGRT_PACKETS  // with packets, 1_packet_candidates.cl has counted some candidates' segments
    if (c.count != UNCOUNTED) return;
#endif
    if (!ray_of(frame, rays, number_of(frame, listed, c.ray), &r, &wanted)) return;
    solid = g.solids[c.solid];
    own = ray_at(solid, r);
    if (!collect_many(g, solid, c.solid, own, wanted.t_min, 0, &count, &near)) {
        const segments h = collect_few(g, solid, own, wanted.t_min);
        count = h.count;
        if (count == 1) put_segment(segment, c.solid, h.in0, h.in0_surface, h.out0, h.out0_surface);
    }
    candidate->count = near ? count | IN_SOME_FACE : count;
}

// Counts a candidate's segments. The only segment of a candidate is kept in `found`, so that kernel 2 need not find it
// again. Candidates of more segments are too rare to be worth the memory.
__kernel void count_segments(__global const Frame* frame, GEOMETRY_ARGS, __global const RayRecord* rays,
                             __global const u32* listed, __global const CandidateCount* places,
                             __global Candidate* candidates, __global Boundary* found) {
    const u32 id = (u32)get_global_id(0);
    if (id < candidates_of(frame, places))
        intersect_candidate(frame, GEOMETRY, rays, listed, candidates + id, found + 2 * (size_t)id);
}

// Adds up each ray's counts, and gives each candidate its offset among the ray's segments. `deep_words`: the count of
// words for a deep ray, which needs none: DEEP_WORDS if the sum is to show that there is a deep ray, else 0.
__kernel void sum_segments(__global const Frame* frame, __global const CandidateCount* places,
                           __global Candidate* candidates, u32 deep_words, __global RayCount* counts,
                           __global BatchReport* report) {
    u32 id = (u32)get_global_id(0), i;
    RayCount count;
    if (id >= frame->ray_count) return;
    if (id == 0 && frame->rows) report->candidates = places[frame->ray_count].candidates;
    if (places[frame->ray_count].candidates > frame->candidate_capacity) {
        counts[id].segments = counts[id].words = COUNT_MAX;
        return;
    }
    count.segments = 0;
    for (i = places[id].candidates; i < places[id + 1].candidates; ++i) {
        candidates[i].before = count.segments;
        count.segments += candidates[i].count & ~IN_SOME_FACE;
    }
    count.words =
        count.segments > DEEP_SEGMENTS ? deep_words : partitions_of(count.segments) * words_of(count.segments);
    counts[id] = count;
}
