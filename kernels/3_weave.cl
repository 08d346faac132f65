// Kernel 3: a ray's segments -> its partitions, in order of distance.
//
//   segments   A  |-------------|
//              B         |--------------|
//              C     |---------|
//   ends          A  C   B     C A      B
//   partitions    |P1|P2 |  P3 |4|  P5  |        a doubly linked list by index, a bit array each:
//   bits A B C    100 101 111 110 010            which segments cover the partition
//
// First the ends themselves are linked in order (t, then number). Then one pass from the front takes all ends within
// Frame.tolerance (a length, whatever the direction's) of the first of them as one event, so that surfaces that coincide change together, whichever comes
// first: a segment that begins and ends in one event vanishes. The event's t is that of its first end.
// A partition's node is the node of its event's first end, so the list needs no memory but the 2 * segments nodes.
#include "camera.h"

// Links the ray's ends by ascending t; equal t by ascending number. Most ends come nearly sorted: looked for from the back.
static u32 link_ends(__global const End* ends, __global PartitionNode* list, u32 count) {
    u32 head = NONE, tail = NONE, e;
    for (e = 0; e < count; ++e) {
        real t = ends[e].t;
        u32 before = tail;
        u32 after;
        while (before != NONE && ends[before].t > t) before = list[before].prev;
        after = before == NONE ? head : list[before].next;
        list[e].prev = before;
        list[e].next = after;
        if (before == NONE) {
            head = e;
        } else {
            list[before].next = e;
        }
        if (after == NONE) {
            tail = e;
        } else {
            list[after].prev = e;
        }
    }
    return head;
}

static int has_bit(__global const u32* bits, u32 index) { return (bits[index >> 5] >> (index & 31u)) & 1u; }

__kernel void weave(__global const Frame* frame, __global const RayRecord* rays, __global const RayCount* offsets,
                    __global End* all_ends, __global PartitionNode* all_nodes, __global u32* all_bits,
                    __global RayResult* results) {
    u32 id = (u32)get_global_id(0);
    RayResult result;
    RayCount offset;
    ray3 r;
    real tolerance;
    u32 segments, words, e, open, open_bits, last;
    __global End* ends;
    __global PartitionNode* list;
    __global u32* bits;
    if (id >= frame->ray_count) return;
    result.first = NONE;
    result.partitions = result.overlaps = 0;
    offset = offsets[id];
    segments = offsets[id + 1].segments - offset.segments;
    if (segments == 0 || !ray_of(frame, rays, number_of(frame, rays, id), &r)) {
        results[id] = result;
        return;
    }
    ends = all_ends + 2 * (size_t)offset.segments;
    list = all_nodes + 2 * (size_t)offset.segments;
    bits = all_bits + offset.words;
    words = words_of(segments);
    tolerance = tolerance_along(frame, r);

    e = link_ends(ends, list, 2 * segments);
    open = NONE;       // the partition that the front stands in
    open_bits = NONE;  // where its bits are; NONE: no segment is open
    last = NONE;       // the last partition of the list
    while (e != NONE) {
        u32 event = e;
        real t = ends[event].t;
        __global u32* now = bits + event * words;
        u32 in_end = NONE, out_end = NONE, w, any = 0;
        // All ends of this event change sides at once.
        for (w = 0; w < words; ++w) now[w] = open_bits == NONE ? 0 : bits[open_bits * words + w];
        do {
            now[e >> 6] ^= 1u << (e >> 1 & 31u);
            e = list[e].next;
        } while (e != NONE && (ends[e].t == t || ends[e].t - t <= tolerance));
        // The surface there is the first end whose segment does not vanish: one that begins, for the partition behind;
        // one that ends, for the partition before.
        {
            u32 i = event;
            while (i != e) {
                u32 segment = i >> 1;
                int after = has_bit(now, segment);
                ends[i].t = t;
                if (!(i & 1u) && after && in_end == NONE) in_end = i;
                if ((i & 1u) && !after && out_end == NONE && open_bits != NONE &&
                    has_bit(bits + open_bits * words, segment))
                    out_end = i;
                i = list[i].next;
            }
        }
        if (in_end == NONE && out_end == NONE) continue;
        if (open != NONE) list[open].out_end = out_end != NONE ? out_end : in_end;
        for (w = 0; w < words; ++w) any |= now[w];
        if (any) {
            list[event].in_end = in_end != NONE ? in_end : out_end;
            list[event].region = NONE;
            list[event].prev = last;
            if (last != NONE) {
                list[last].next = event;
            } else {
                result.first = event;
            }
            last = open = open_bits = event;
            ++result.partitions;
        } else {
            open = open_bits = NONE;
        }
    }
    if (last != NONE) list[last].next = NONE;
    results[id] = result;
}
