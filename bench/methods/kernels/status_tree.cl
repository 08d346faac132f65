// Jansen's status tree: a bit a node is kept from partition to partition. Where a segment begins or ends, its leaves
// flip, and each walks up until a gate's value does not change. A work-item is a ray.
//
// Nodes stand in pairs of brothers, so a node's brother is node ^ 1. A bit of `memory` says whether the node differs
// from what it is where no solid is: all are 0 again when the ray has left all solids.
// Tables:
//   2  of each node: 2 bits the gate above, 30 bits the node above; of a root (gate 0) the region
//   3  a bit a node: its value where no solid is
//   4  of each solid where its leaves begin, and one behind the last
//   5  the leaves' nodes
//   6  how many words of `memory` a ray has
//   7  of each region its root
#define ABOVE_MASK 0x3fffffffu
#define GATE_ROOT 0u

typedef struct {
    __global const u32* tables;
    __global u32* state;
    u32 least;  // the least region that claims; NONE: there is none
    u32 lost;   // it does not any more, and another has to be looked for
} status;

static u32 status_of(const status* s, u32 node) {
    return ((s->state[node >> 5] ^ s->tables[s->tables[3] + (node >> 5)]) >> (node & 31u)) & 1u;
}

static void flip_solid(status* s, u32 solid) {
    __global const u32* const nodes = s->tables + s->tables[2];
    __global const u32* const firsts = s->tables + s->tables[4];
    __global const u32* const leaves = s->tables + s->tables[5];
    u32 i;
    for (i = firsts[solid]; i < firsts[solid + 1]; ++i) {
        u32 node = leaves[i], gate;
        do {
            const u32 above = nodes[node];
            s->state[node >> 5] ^= 1u << (node & 31u);
            gate = above >> GATE_SHIFT;
            if (gate == GATE_ROOT) {
                const u32 region = above & ABOVE_MASK;
                if (status_of(s, node)) {
                    if (region < s->least) s->least = region;
                } else if (region == s->least) {
                    s->lost = 1;
                }
                break;
            }
            // An and changes with one operand where the other is true, an or where it is false, a xor always.
            if (gate == GATE_INTERSECTION ? !status_of(s, node ^ 1u)
                : gate == GATE_UNION      ? status_of(s, node ^ 1u)
                                          : 0u)
                break;
            node = above & ABOVE_MASK;
        } while (1);
    }
}

static u32 least_status(status* s, const coverage* c) {
    if (s->lost) {
        u32 region = next_region(s->tables, c, 0);
        while (region != NONE && !status_of(s, s->tables[s->tables[7] + region]))
            region = next_region(s->tables, c, region + 1);
        s->least = region;
        s->lost = 0;
    }
    return s->least;
}

// Do the segments of `bits` from `first` to before `end`, which are one solid's, cover? `missed` as in coverage.
static u32 any_covers(__global const Boundary* boundaries, __global const u32* bits, u32 first, u32 end, u32 missed) {
    u32 i;
    for (i = first; i < end; ++i)
        if ((bits[i >> 5] >> (i & 31u) & 1u) && !(boundaries[2 * i].surface & missed)) return 1;
    return 0;
}

// Flips the solids that cover `before` (0: nothing does) and not `after`, or the other way round.
static void change(status* s, __global const Boundary* boundaries, u32 segments, __global const u32* before,
                   u32 missed_before, __global const u32* after, u32 missed_after) {
    u32 word, words = words_of(segments);
    for (word = 0; word < words; ++word) {
        u32 bits = (before ? before[word] : 0u) | (after ? after[word] : 0u);
        if (missed_before == missed_after) bits = (before ? before[word] : 0u) ^ (after ? after[word] : 0u);
        while (bits) {
            const u32 segment = 32 * word + lowest(bits), solid = boundaries[2 * segment].solid;
            u32 first = segment, end = segment + 1, is_first;
            bits &= bits - 1;
            while (first > 0 && boundaries[2 * first - 2].solid == solid) --first;
            while (end < segments && boundaries[2 * end].solid == solid) ++end;
            // A solid of several segments is looked at once: by the first of them that is looked at.
            is_first = 1;
            if (end - first > 1) {
                u32 i;
                for (i = first; i < segment; ++i) {
                    const u32 b = before ? before[i >> 5] >> (i & 31u) & 1u : 0u;
                    const u32 a = after ? after[i >> 5] >> (i & 31u) & 1u : 0u;
                    if (missed_before == missed_after ? a != b : a | b) is_first = 0;
                }
            }
            if (is_first && (before ? any_covers(boundaries, before, first, end, missed_before) : 0u) !=
                                (after ? any_covers(boundaries, after, first, end, missed_after) : 0u))
                flip_solid(s, solid);
        }
    }
}

__kernel void evaluate_status_tree(__global const Frame* frame, __global const RayCount* offsets,
                                   __global const Boundary* all_boundaries, __global const u32* all_bits,
                                   __global PartitionNode* all_nodes, __global const u32* tables,
                                   __global u32* memory) {
    const u32 ray = (u32)get_global_id(0);
    RayCount offset;
    coverage c;
    status s;
    __global PartitionNode* nodes;
    __global const u32* before = 0;
    u32 k;
    if (ray >= frame->ray_count || !segments_fit(frame, offsets)) return;
    offset = offsets[ray];
    c.segments = offsets[ray + 1].segments - offset.segments;
    if (c.segments == 0) return;
    c.boundaries = all_boundaries + 2 * (size_t)offset.segments;
    nodes = all_nodes + 2 * (size_t)offset.segments;
    s.tables = tables;
    s.state = memory + (size_t)ray * tables[tables[6]];
    s.least = NONE;
    s.lost = 0;
    for (k = first_partition(nodes, c.segments); k != NONE; k = nodes[k].next) {
        u32 owner = NONE;
        c.bits = all_bits + offset.words + k * words_of(c.segments);
        change(&s, c.boundaries, c.segments, before, 0, c.bits, 0);
        before = c.bits;
        list_coverage(&c, 0);
        if (c.marked && !is_alone(&c)) {  // to each side of the face that the ray runs in, and back
            u32 side, missed = 0;
            for (side = 1; side < SIDES; ++side) {
                u32 here;
                change(&s, c.boundaries, c.segments, c.bits, missed, c.bits, missed_on(side));
                missed = missed_on(side);
                list_coverage(&c, missed);
                here = least_status(&s, &c);
                if (here < owner) owner = here;
            }
            change(&s, c.boundaries, c.segments, c.bits, missed, c.bits, 0);
        } else {
            owner = least_status(&s, &c);
        }
        nodes[k].owner = owner;
    }
}
