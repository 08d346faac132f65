// Kernel 3: makes partitions of a ray's segments, in order of distance.
//
//   segments   A  |-------------|
//              B         |--------------|
//              C     |---------|
//   boundaries    A  C   B     C A      B
//   partitions    |P1|P2 |  P3 |4|  P5  |        a doubly linked list by index, a bit array each:
//   bits A B C    100 101 111 110 010            which segments cover the partition
//
// First the position of each boundary is found: the number of boundaries before it (by t, then by number). Then one
// sweep, front to back, makes events. An event is a boundary together with all boundaries that follow within
// Frame.tolerance (a length, whatever the direction's length). So coinciding surfaces take effect together, whichever
// comes first, and a segment that begins and ends in one event vanishes. The event's t is the t of its first boundary.
// A partition's node has the index of this boundary's position, so the list needs no memory but the 2 * segments nodes.
#include "traversal/camera.h"
#include "shared/capacity.h"

static void order_boundary(u32 id, u32 ray, __global const RayCount* offsets, __global const Boundary* all_boundaries,
                           __global PartitionNode* all_nodes) {
    const u32 count = 2 * (offsets[ray + 1].segments - offsets[ray].segments);
    const size_t base = 2 * (size_t)offsets[ray].segments;
    __global const Boundary* const boundaries = all_boundaries + base;
    const u32 number = id - (u32)base;
    const real t = boundaries[number].t;
    u32 i, place = 0;
    all_nodes[id].owner = ray;
    if (count > 2 * DEEP_SEGMENTS) return;
    for (i = 0; i < count; ++i) place += boundaries[i].t < t || (boundaries[i].t == t && i < number);
    all_nodes[base + place].next = number;
}

// Orders one boundary a work-item. `ray_of_boundary`: kernel 2 left the boundary's ray in the words of `bits`.
__kernel void order_boundaries(__global const Frame* frame, __global const RayCount* offsets,
                               __global const Boundary* all_boundaries, __global const u32* ray_of_boundary,
                               __global PartitionNode* all_nodes) {
    const u32 id = (u32)get_global_id(0);
    if (id < 2 * segments_of(frame, offsets))
        order_boundary(id, ray_of_boundary[id], offsets, all_boundaries, all_nodes);
}

static u32 has_bit(__global const u32* bits, u32 index) { return (bits[index >> 5] >> (index & 31u)) & 1u; }

__kernel void weave(__global const Frame* frame, __global const RayRecord* rays, __global const u32* listed,
                    __global const RayCount* offsets, __global Boundary* all_boundaries,
                    __global PartitionNode* all_nodes, __global u32* all_bits, __global RayTally* tallies) {
    const u32 id = (u32)get_global_id(0);
    RayTally tally;
    RayCount offset;
    ray3 r;
    ray_range wanted;
    real tolerance, t_e;
    u32 segment_count, words, at = 0, open, open_bits, last, e, after_e;
    __global Boundary* boundaries;
    __global PartitionNode* list;
    __global u32* bits;
    if (id >= frame->ray_count || !segments_fit(frame, offsets)) return;
    tally.partitions = tally.overlaps = 0;
    offset = offsets[id];
    segment_count = offsets[id + 1].segments - offset.segments;
    if (segment_count > DEEP_SEGMENTS) return;
    if (segment_count == 0 || !ray_of(frame, rays, number_of(frame, listed, id), &r, &wanted)) {
        tallies[id] = tally;
        return;
    }
    boundaries = all_boundaries + 2 * (size_t)offset.segments;
    list = all_nodes + 2 * (size_t)offset.segments;
    bits = all_bits + offset.words;
    words = words_of(segment_count);
    tolerance = tolerance_along(frame, r);
    // e: the first boundary that is not passed yet. after_e: the boundary behind e, which is loaded one step ahead, so
    // that the loop does not wait.
    e = list[0].next;
    after_e = list[1].next;
    t_e = boundaries[e].t;

    open = NONE;       // the partition that the sweep is in
    open_bits = NONE;  // where its bits are; NONE: no segment is open
    last = NONE;       // the last partition of the list
    while (at < 2 * segment_count) {
        const u32 event = at;
        const u32 first = e;
        const real t = t_e;
        __global u32* now = bits + event * words;
        u32 in_boundary = NONE, out_boundary = NONE, w, i, any = 0;
        // All segments of this event's boundaries open or close at once.
        for (w = 0; w < words; ++w) now[w] = open_bits == NONE ? 0 : bits[open_bits * words + w];
        do {
            now[e >> 6] ^= 1u << (e >> 1 & 31u);
            if (++at == 2 * segment_count) break;
            e = after_e;
            t_e = boundaries[e].t;
            if (at + 1 < 2 * segment_count) after_e = list[at + 1].next;
        } while (t_e == t || t_e - t <= tolerance);
        // The surface at the event is the surface of the first boundary whose segment does not vanish. For the
        // partition behind the event a segment begins at this boundary; for the partition before the event a segment
        // ends there.
        for (i = event; i < at; ++i) {
            const u32 ended = i == event ? first : list[i].next, segment = ended >> 1;
            const u32 after = has_bit(now, segment);
            const u32 before = open_bits != NONE && has_bit(bits + open_bits * words, segment);
            if (i != event) boundaries[ended].t = t;
            if (!(ended & 1u) && after && in_boundary == NONE) in_boundary = ended;
            if ((ended & 1u) && !after && before && out_boundary == NONE) out_boundary = ended;
        }
        for (i = event; i < at; ++i) list[i].in_boundary = NONE;
        if (in_boundary == NONE && out_boundary == NONE) continue;
        if (open != NONE) list[open].out_boundary = out_boundary != NONE ? out_boundary : in_boundary;
        for (w = 0; w < words; ++w) any |= now[w];
        if (any) {
            list[event].in_boundary = in_boundary != NONE ? in_boundary : out_boundary;
            if (last != NONE) list[last].next = event;
            last = open = open_bits = event;
            ++tally.partitions;
        } else {
            open = open_bits = NONE;
        }
    }
    if (last != NONE) list[last].next = NONE;
    tallies[id] = tally;
}
