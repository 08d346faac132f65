// Kernels 3 and 4 for deep rays: a ray of n segments takes n log n steps, where weave and evaluate take n^2 and more.
//
//   sort blocks -> merge, merge, ... -> sweep, sweep, ...
//
// The boundaries are sorted as order_boundaries sorts them: in blocks, which are merged two by two. The order is stored
// in the nodes: by turns in `in_boundary` and `next`, and in `next` at last. Then one work-item a ray passes the events
// from front to back. Partitions and their nodes are the same as weave's. In place of the partitions' bits, the sweep
// keeps a count of each solid's open segments and a status tree of the regions (boolean/status_tree.h). Where a solid
// begins or ceases to cover, only a few words of them change. A launch passes a limited number of boundaries, so that
// it is short, and the next launch goes on.
#include "traversal/camera.h"
#include "boolean/status_tree.h"
#include "geometry/beyond.h"

#define FIELD_IN_END 0u
#define FIELD_NEXT 2u
// The number of the boundary at position `place` of a ray's order.
static __global u32* in_order(__global PartitionNode* nodes, u32 field, u32 place) {
    return (__global u32*)(nodes + place) + field;
}

// The deep ray that a block belongs to.
static u32 deep_ray_of(__global const DeepRay* deep, u32 count, u32 block) {
    u32 low = 0, high = count;  // deep[low].block <= block < deep[high].block
    while (high - low > 1) {
        const u32 middle = (low + high) >> 1;
        if (deep[middle].block <= block) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

// A block of a deep ray's order: its boundaries have the positions from `first` on.
typedef struct {
    __global const Boundary* boundaries;  // of the whole ray
    __global PartitionNode* nodes;        // of the whole ray
    u32 boundary_count, first;
} deep_block;

static deep_block block_at(__global const DeepRay* deep, u32 count, u32 id, __global const RayCount* offsets,
                           __global const Boundary* all_boundaries, __global PartitionNode* all_nodes) {
    const DeepRay ray = deep[deep_ray_of(deep, count, id)];
    const RayCount offset = offsets[ray.ray];
    deep_block b;
    b.boundaries = all_boundaries + 2 * (size_t)offset.segments;
    b.nodes = all_nodes + 2 * (size_t)offset.segments;
    b.boundary_count = 2 * (offsets[ray.ray + 1].segments - offset.segments);
    b.first = DEEP_BLOCK * (id - ray.block);
    return b;
}

static int boundary_is_before(__global const Boundary* boundaries, u32 a, u32 b) {
    const real t_a = boundaries[a].t, t_b = boundaries[b].t;
    return t_a < t_b || (t_a == t_b && a < b);
}

// Sorts blocks of boundaries, one block a work-item.
__kernel void sort_deep_blocks(__global const DeepRay* deep, u32 count, u32 blocks, __global const RayCount* offsets,
                               __global const Boundary* all_boundaries, __global PartitionNode* all_nodes, u32 field) {
    const u32 id = (u32)get_global_id(0);
    u32 order[DEEP_BLOCK], k, size;
    deep_block b;
    if (id >= blocks) return;
    b = block_at(deep, count, id, offsets, all_boundaries, all_nodes);
    size = b.boundary_count - b.first < DEEP_BLOCK ? b.boundary_count - b.first : DEEP_BLOCK;
    for (k = 0; k < size; ++k) {
        u32 place = k;
        for (; place > 0 && boundary_is_before(b.boundaries, b.first + k, order[place - 1]); --place)
            order[place] = order[place - 1];
        order[place] = b.first + k;
    }
    for (k = 0; k < size; ++k) *in_order(b.nodes, field, b.first + k) = order[k];
}

// Merges runs of `run` boundaries, two by two. A work-item makes one block of the result, whose boundaries come from
// both runs. Bisection finds how many come from the left run.
__kernel void merge_deep_runs(__global const DeepRay* deep, u32 count, u32 blocks, __global const RayCount* offsets,
                              __global const Boundary* all_boundaries, __global PartitionNode* all_nodes, u32 field,
                              u32 run) {
    const u32 id = (u32)get_global_id(0), to = field == FIELD_NEXT ? FIELD_IN_END : FIELD_NEXT;
    u32 place, last, left, left_end, right, right_end, low, high, before;
    deep_block b;
    if (id >= blocks) return;
    b = block_at(deep, count, id, offsets, all_boundaries, all_nodes);
    place = b.first;
    last = place + DEEP_BLOCK < b.boundary_count ? place + DEEP_BLOCK : b.boundary_count;
    left = place - place % (2 * run);
    left_end = right = left + run < b.boundary_count ? left + run : b.boundary_count;
    right_end = right + run < b.boundary_count ? right + run : b.boundary_count;
    before = place - left;  // boundaries of both runs in the blocks before this one
    low = before > right_end - right ? before - (right_end - right) : 0;
    high = before < left_end - left ? before : left_end - left;
    while (low < high) {
        const u32 middle = (low + high) >> 1;
        if (boundary_is_before(b.boundaries, *in_order(b.nodes, field, left + middle),
                               *in_order(b.nodes, field, right + before - middle - 1))) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    left += low;
    right += before - low;
    for (; place < last; ++place) {
        int takes_left = right == right_end;
        if (left < left_end && right < right_end)
            takes_left =
                boundary_is_before(b.boundaries, *in_order(b.nodes, field, left), *in_order(b.nodes, field, right));
        *in_order(b.nodes, to, place) = *in_order(b.nodes, field, takes_left ? left++ : right++);
    }
}

// Clears the status trees of `count` rays, SIDES trees a ray, to the state in which no solid covers: the clusters'
// functions, then the set of regions.
__kernel void clear_status(__global const u32* outside, u32 cluster_words, u32 words, u32 count, __global u32* status) {
    const u32 id = (u32)get_global_id(0);
    if (id < count) status[id] = id % words < cluster_words ? outside[id % words] : 0;
}

// A scene's status tree, and its size.
typedef struct {
    __global const u32* links;
    __global const u32* first_leaves;  // one a solid, and one more: where the solid's leaves begin
    __global const u32* leaves;        // cluster << 2 | the bits of its function that change where the solid covers
    u32 cluster_words, regions;
} status_tree;

// Opens or closes a segment. Its solid begins or ceases to cover if no other segment of the solid is open. Returns 1 if
// the solid does.
static u32 change_cover(status_tree tree, u32 solid, u32 opens, __global u32* covers, __global u32* status) {
    const u32 count = *covers, changes = count == !opens;
    *covers = opens ? count + 1 : count - 1;
    if (changes) {
        u32 leaf;
        for (leaf = tree.first_leaves[solid]; leaf < tree.first_leaves[solid + 1]; ++leaf) {
            const u32 region = change_leaf(status, tree.links, tree.leaves[leaf] >> 2, tree.leaves[leaf] & 3u);
            if (region != NONE) toggle(status + tree.cluster_words, tree.regions, region);
        }
    }
    return changes;
}

// Returns PartitionNode.owner for the open segments, by the rule of find_claim_beside. `first`, `end`: the range of the
// sides.
static u32 deep_owner(status_tree tree, __global const u32* ranks, __global const u32* status, u32 words, u32 first,
                      u32 end, u32 beyond) {
    u32 side, owner = NONE, is_overlap = 0;
    for (side = first; side < end; ++side) {
        __global const u32* const set = status + side * words + tree.cluster_words;
        const u32 least = member_from(set, tree.regions, 0);
        const u32 other = least != NONE ? member_from(set, tree.regions, least + 1) : NONE;
        const u32 overlaps = other != NONE && same_rank(ranks, least, other);
        if (least > owner || (missed_on(side) & beyond)) continue;
        is_overlap = overlaps || (is_overlap && least == owner);
        owner = least;
    }
    return owner | (is_overlap ? OVERLAP : 0u);
}

// Starts a deep ray before its first event: no segment is open.
static u32 start_deep_ray(__global const Boundary* boundaries, u32 count, u32 beyond,
                          __global DeepSegment* of_segment) {
    u32 i, side, first = 0, solid = NONE, marked = 0;
    for (i = 0; i < count; ++i) {
        const Boundary end = boundaries[2 * i];
        DeepSegment s;
        if (end.solid != solid) {
            first = i;
            solid = end.solid;
        }
        marked |= end.surface & MISSED;
        s.first = first;
        s.is_open = 0;
        for (side = 0; side < SIDES; ++side) s.covers[side] = 0;
        of_segment[i] = s;
    }
    return marked || beyond ? SIDES : 1u;
}

// Passes over the boundaries of the next event, from swept.at on. Their segments will open or close together.
static void find_event(DeepRay* swept, u32 boundary_count, real tolerance, __global Boundary* boundaries,
                       __global const PartitionNode* list, __global DeepSegment* of_segment) {
    u32 at = swept->at, e = list[at].next, i;
    real t_e = boundaries[e].t;
    const real t = t_e;
    do {
        of_segment[e >> 1].is_open ^= 1u;
        if (++at == boundary_count) break;
        e = list[at].next;
        t_e = boundaries[e].t;
    } while (t_e == t || t_e - t <= tolerance);
    swept->event = swept->at;
    swept->in_boundary = swept->out_boundary = NONE;
    for (i = swept->event; i < at; ++i) {
        const u32 ended = list[i].next, is_open = of_segment[ended >> 1].is_open;
        if (i != swept->event) boundaries[ended].t = t;
        if (!(ended & 1u) && (is_open & 1u) && swept->in_boundary == NONE) swept->in_boundary = ended;
        if ((ended & 1u) && is_open == 2u && swept->out_boundary == NONE) swept->out_boundary = ended;
    }
    swept->at = at;
}

// Sweeps one deep ray a work-item, from `first_ray` on. `limit`: how many boundaries a launch passes at most; each
// boundary may change all of the status tree above its solid's leaves. `all_status`: made by clear_status, a tree for
// each side of a ray. When a ray is done, its trees are clear again for the next ray.
__kernel void sweep_deep_rays(__global const Frame* frame, __global const RayRecord* rays, __global const u32* listed,
                              __global DeepRay* deep, u32 first_ray, u32 first_segment, u32 count,
                              __global const RayCount* offsets, __global Boundary* all_boundaries,
                              __global PartitionNode* all_nodes, __global DeepSegment* all_segments,
                              __global u32* all_status, u32 cluster_words, u32 regions, __global const u32* links,
                              __global const u32* first_leaves, __global const u32* leaves, u32 limit,
                              __global RayTally* tallies) {
    const u32 id = (u32)get_global_id(0), words = cluster_words + words_of_set(regions);
    u32 boundary_count, stop, beyond;
    DeepRay swept;
    RayCount offset;
    status_tree tree;
    ray3 r;
    ray_range wanted;
    real tolerance;
    __global Boundary* boundaries;
    __global PartitionNode* list;
    __global DeepSegment* of_segment;
    __global u32* status;
    if (id >= count) return;
    swept = deep[first_ray + id];
    offset = offsets[swept.ray];
    boundary_count = 2 * (offsets[swept.ray + 1].segments - offset.segments);
    if (swept.changed == boundary_count || !ray_of(frame, rays, number_of(frame, listed, swept.ray), &r, &wanted))
        return;
    tolerance = tolerance_along(frame, r);
    beyond = sides_beyond(frame, r);
    boundaries = all_boundaries + 2 * (size_t)offset.segments;
    list = all_nodes + 2 * (size_t)offset.segments;
    of_segment = all_segments + (swept.segment - first_segment);
    status = all_status + SIDES * (size_t)id * words;
    tree.links = links;
    tree.first_leaves = first_leaves;
    tree.leaves = leaves;
    tree.cluster_words = cluster_words;
    tree.regions = regions;
    if (swept.changed == 0) swept.sides = start_deep_ray(boundaries, boundary_count / 2, beyond, of_segment);
    stop = boundary_count - swept.changed > limit ? swept.changed + limit : boundary_count;
    while (swept.changed < stop) {
        if (swept.changed == swept.at) find_event(&swept, boundary_count, tolerance, boundaries, list, of_segment);
        for (; swept.changed < swept.at && swept.changed < stop; ++swept.changed) {
            const u32 segment = list[swept.changed].next >> 1, is_open = of_segment[segment].is_open;
            list[swept.changed].in_boundary = NONE;
            if (is_open == 1u || is_open == 2u) {  // a segment that vanishes is left out
                const Boundary end = boundaries[2 * segment];
                __global u32* const covers = of_segment[of_segment[segment].first].covers;
                u32 side;
                of_segment[segment].is_open = is_open == 1u ? 3u : 0u;
                for (side = 0; side < swept.sides; ++side)
                    if (!(end.surface & missed_on(side)) &&
                        change_cover(tree, end.solid, is_open == 1u, covers + side, status + side * words) && side == 0)
                        swept.open_solids = is_open == 1u ? swept.open_solids + 1 : swept.open_solids - 1;
            }
        }
        if (swept.changed < swept.at || (swept.in_boundary == NONE && swept.out_boundary == NONE)) continue;
        if (swept.open != NONE)
            list[swept.open].out_boundary = swept.out_boundary != NONE ? swept.out_boundary : swept.in_boundary;
        if (swept.open_solids) {
            const u32 moved = swept.sides > 1 && (swept.open_solids > 1 || beyond);
            list[swept.event].in_boundary = swept.in_boundary != NONE ? swept.in_boundary : swept.out_boundary;
            list[swept.event].owner =
                deep_owner(tree, frame->rank_ends, status, words, moved, moved ? SIDES : 1u, beyond);
            if (swept.last != NONE) list[swept.last].next = swept.event;
            swept.last = swept.open = swept.event;
            ++swept.partitions;
        } else {
            swept.open = NONE;
        }
    }
    if (swept.changed == boundary_count) {
        RayTally tally;
        if (swept.last != NONE) list[swept.last].next = NONE;
        tally.partitions = swept.partitions;
        tally.overlaps = 0;
        tallies[swept.ray] = tally;
    }
    deep[first_ray + id] = swept;
}
