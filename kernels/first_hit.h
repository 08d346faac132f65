// The first claimed partition of a ray, without the others: front to back, in the ray's own memory.
//
// The hierarchy is walked nearest box first. What is still unseen lies behind the nearest box that is left over, so every
// event before that distance is complete: its partition is evaluated as kernels 3 and 4 would, and the first claim ends
// the walk. Segments that have ended make room for others. A ray that needs more room than there is goes the long way.
//
//   boxes      |--seen--|   |--seen--|      |--unseen--|
//   ends        i     o  i    i   o         :       o  o
//   events      1     2  3    4   5         : these may be joined by others yet
#ifndef CSGRT_FIRST_HIT_H
#define CSGRT_FIRST_HIT_H

#include "boolean.h"
#include "camera.h"
#include "geometry/collect.h"
#include "shared/slab.h"

#ifndef PENDING
#define PENDING 32u     // segments that a ray holds at a time; their cover is one word
#endif
#define WALK_STACK 64u  // boxes left over at a time

// The segments that have begun or will begin, and their ends not yet passed, in order of distance.
typedef struct {
    End ends[2 * PENDING];  // of segment s: 2 s and 2 s + 1
    unsigned char order[2 * PENDING];
    u32 count;  // of ends in `order`
    u32 used;   // bit s: there is a segment s
    u32 open;   // bit s: it covers the partition that the front stands in
    End seen;   // where that partition begins, if it is claimed
    u32 region;  // by this one; NONE: it is not
    u32 from_within;  // it begins where a solid ends
    u32 steps;  // solids taken up and partitions evaluated
} front;

typedef struct {
    Geometry g;
    GLOBAL const BvhNode* nodes;
    GLOBAL const StartRecord* starts;
    GLOBAL const u32* leaves;
    GLOBAL const u32* trees;
} scene_tables;

// In the order in which kernel 3 links ends: by distance, then solid, then as they stand in the solid.
FN void insert_end(front* w, u32 number) {
    const real t = w->ends[number].t;
    const u32 solid = w->ends[number].solid;
    u32 i = w->count++;
    for (; i > 0; --i) {
        const u32 before = w->order[i - 1];
        if (w->ends[before].t < t || (w->ends[before].t == t && w->ends[before].solid <= solid)) break;
        w->order[i] = (unsigned char)before;
    }
    w->order[i] = (unsigned char)number;
}

// Takes up the solid's segments. 0: there is no room.
FN int take_solid(front* w, Geometry g, u32 index, ray3 r, real t_min) {
    SolidRecord solid = g.solids[index];
    u32 count, i;
    ++w->steps;
#if (CSGRT_SOLIDS) & MANY_SEGMENTS
    End found[2 * PENDING];
    if ((MANY_SEGMENTS >> solid.type & 1u) && collect(g, solid, index, r, t_min, (ENDS End*)0) > PENDING) return 0;
#else
    End found[4];
#endif
    count = collect(g, solid, index, r, t_min, found);
    for (i = 0; i < count; ++i) {
        u32 slot;
        if (w->used == 0xffffffffu) return 0;
        slot = 31u - clz(~w->used);
        w->used |= 1u << slot;
        w->ends[2 * slot] = found[2 * i];
        w->ends[2 * slot + 1] = found[2 * i + 1];
        insert_end(w, 2 * slot);
        insert_end(w, 2 * slot + 1);
    }
    return 1;
}

FN u32 first_claim(const front* w, scene_tables s, SolidFilter changed) {
    cover c;
    covered_solids covered;
    c.ends = w->ends;
    c.bits = &w->open;
    c.segments = PENDING;
    c.solids = s.g.solids;
    c.starts = s.starts;
    c.leaves = s.leaves;
    c.trees = s.trees;
    covered = list_covered(c);
    return find_claim(c, &covered, 0, changed).least;
}

// Passes all events that nothing can join that comes at `horizon` or later. 1: the first partition to be seen is known.
FN int advance(front* w, scene_tables s, real tolerance, real t_min, int all, real horizon) {
    u32 done = 0, i, found = 0;
    while (done < w->count && !found) {
        const real t = w->ends[w->order[done]].t;
        const u32 before = w->open;
        u32 end = done, in_end = NONE, out_end = NONE;
        SolidFilter changed;
        changed.even = changed.odd = 0;
        if (!all && !(horizon - t > tolerance)) break;
        do {
            w->open ^= 1u << (w->order[end] >> 1);
            changed = with(changed, filter_of(w->ends[w->order[end]].solid));
            ++end;
        } while (end < w->count && (w->ends[w->order[end]].t == t || w->ends[w->order[end]].t - t <= tolerance));
        for (i = done; i < end; ++i) {
            const u32 number = w->order[i], bit = 1u << (number >> 1);
            if (!(number & 1u)) {
                if ((w->open & bit) && in_end == NONE) in_end = number;
            } else {
                if (!(w->open & bit) && (before & bit) && out_end == NONE) out_end = number;
                w->used &= ~bit;
            }
        }
        done = end;
        if (in_end == NONE && out_end == NONE) continue;
        // What ends before t_min is not seen.
        if (w->region != NONE && t > t_min) {
            found = 1;
        } else {
            if (w->region != NONE) changed = all_solids();
            w->region = w->open ? first_claim(w, s, changed) : NONE;
            ++w->steps;
            w->seen = w->ends[in_end != NONE ? in_end : out_end];
            w->seen.t = t;
            w->from_within = in_end == NONE;
            found = w->region != NONE && t > t_min;
        }
    }
    w->count -= done;
    for (i = 0; i < w->count; ++i) w->order[i] = w->order[i + done];
    return found;
}

// On a GPU a ray that takes long holds up all those beside it: after some solids and partitions it goes the long way, too,
// where a work-item does each of them.
#ifdef CSGRT_PATIENCE
#define IS_PATIENT(steps) ((steps) <= CSGRT_PATIENCE)
#else
#define IS_PATIENT(steps) 1
#endif

#define RAY_MISSES 0
#define RAY_HITS 1
#define RAY_OVERFLOWS 2

FN int first_hit(GLOBAL const Frame* f, scene_tables s, ray3 r, front* w) {
    const real t_min = t_min_along(f, r), tolerance = tolerance_along(f, r);
    slab_ray slabs = make_slab_ray(offset_from(frame_center(f), r.o), r.d, REAL(f->radius), t_min);
    u32 left[WALK_STACK];       // boxes left over,
    float nearest[WALK_STACK];  // and where the nearest of this and those before it is entered
    u32 depth = 0, at = 0, i;
    w->count = w->used = w->open = w->from_within = w->steps = 0;
    w->region = NONE;
    for (i = 0; i < f->unbounded_count; ++i)
        if (!take_solid(w, s.g, i, r, t_min)) return RAY_OVERFLOWS;
    if (slabs.hits_sphere && f->node_count > 0 && box_is_hit(slabs, s.nodes[0])) {
        for (;;) {
            BvhNode node = s.nodes[at];
            if (!node.leaf) {
                const u32 right = s.nodes[at + 1].skip;
                const float first = box_entry(slabs, s.nodes[at + 1]), second = box_entry(slabs, s.nodes[right]);
                const float behind = fmax(first, second);
                if (behind < BOX_MISSED) {
                    if (depth == WALK_STACK) return RAY_OVERFLOWS;
                    left[depth] = first <= second ? right : at + 1;
                    nearest[depth] = depth > 0 ? fmin(nearest[depth - 1], behind) : behind;
                    ++depth;
                }
                if (first < BOX_MISSED || second < BOX_MISSED) {
                    at = first <= second ? at + 1 : right;
                    continue;
                }
            } else {
                u32 solid = node.leaf >> BVH_LEAF_SHIFT;
                const u32 end = solid + (node.leaf & BVH_LEAF_MASK);
                for (; solid < end; ++solid)
                    if (!take_solid(w, s.g, solid, r, t_min)) return RAY_OVERFLOWS;
                if (depth > 0 && w->count > 0 &&
                    advance(w, s, tolerance, t_min, 0, distance_before(slabs, nearest[depth - 1])))
                    return RAY_HITS;
                if (!IS_PATIENT(w->steps)) return RAY_OVERFLOWS;
            }
            if (depth == 0) break;
            at = left[--depth];
        }
    }
    return advance(w, s, tolerance, t_min, 1, REAL(0)) ? RAY_HITS : RAY_MISSES;
}

#endif
