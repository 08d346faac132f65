// The first claimed partition of a ray, without the others: front to back, in the ray's own memory.
//
// The nodes that the ray's block may meet come nearest first (blocks.h). What is still unseen lies behind the next of them,
// so every event before that distance is complete: its partition is evaluated as kernels 3 and 4 would, and the first claim
// ends it all. Segments that have ended make room for others. A ray that needs more room than there is goes the long way.
//
//   nodes      |--seen--|   |--seen--|      |--unseen--|
//   ends        i     o  i    i   o         :       o  o
//   events      1     2  3    4   5         : these may be joined by others yet
#ifndef CSGRT_FIRST_HIT_H
#define CSGRT_FIRST_HIT_H

#include "blocks.h"
#include "boolean.h"
#include "geometry/collect.h"
#include "traverse.h"

#define PENDING FEW                 // segments that a ray holds at a time: its ends are not sorted by solid
#define SLOT_WORDS (PENDING / 32u)  // of a bit for each of them

// The segments that have begun or will begin, and their ends not yet passed, in order of distance.
typedef struct {
    End ends[2 * PENDING];  // of segment s: 2 s and 2 s + 1
    unsigned char order[2 * PENDING];
    u32 count;  // of ends in `order`
    u32 used[SLOT_WORDS];    // bit s: there is a segment s
    u32 open[SLOT_WORDS];    // bit s: it covers the partition that the front stands in
    u32 starts[SLOT_WORDS];  // bit s: its solid starts some term
    End seen;   // where that partition begins, if it is claimed
    u32 region;  // by this one; NONE: it is not
    u32 from_within;  // it begins where a solid ends
} front;

typedef struct {
    Geometry g;
    GLOBAL const BvhNode* nodes;
    GLOBAL const StartRecord* starts;
    GLOBAL const u32* leaves;
    GLOBAL const u32* trees;
} scene_tables;

// A place for one more segment; NONE: there is none.
FN u32 take_slot(front* w, u32 starts) {
    u32 i;
    for (i = 0; i < SLOT_WORDS; ++i) {
        const u32 bit = ~w->used[i] & (w->used[i] + 1u);
        if (!bit) continue;
        w->used[i] |= bit;
        w->starts[i] = starts ? w->starts[i] | bit : w->starts[i] & ~bit;
        return 32u * i + 31u - clz(bit);
    }
    return NONE;
}

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
#if (CSGRT_SOLIDS) & MANY_SEGMENTS
    End found[2 * PENDING];
    if ((MANY_SEGMENTS >> solid.type & 1u) && collect(g, solid, index, r, t_min, (ENDS End*)0) > PENDING) return 0;
#else
    End found[4];
#endif
    count = collect(g, solid, index, r, t_min, found);
    for (i = 0; i < count; ++i) {
        const u32 slot = take_slot(w, solid.start_count);
        if (slot == NONE) return 0;
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
    u32 starting[SLOT_WORDS], i, any = 0;
    for (i = 0; i < SLOT_WORDS; ++i) any |= starting[i] = w->open[i] & w->starts[i];
    if (!any) return NONE;
    c.ends = w->ends;
    c.bits = w->open;
    c.segments = PENDING;
    c.solids = s.g.solids;
    c.starts = s.starts;
    c.leaves = s.leaves;
    c.trees = s.trees;
    covered = list_covered(c);
    c.bits = starting;
    return find_claim(c, &covered, 0, changed).least;
}

// Passes all events that nothing can join that comes at `horizon` or later. 1: the first partition to be seen is known.
FN int advance(front* w, scene_tables s, real tolerance, real t_min, real horizon) {
    u32 done = 0, i, found = 0;
    while (done < w->count && !found) {
        const real t = w->ends[w->order[done]].t;
        u32 before[SLOT_WORDS], end = done, in_end = NONE, out_end = NONE;
        SolidFilter changed;
        changed.even = changed.odd = 0;
        if (!(horizon - t > tolerance)) break;
        for (i = 0; i < SLOT_WORDS; ++i) before[i] = w->open[i];
        do {
            w->open[w->order[end] >> 6] ^= 1u << (w->order[end] >> 1 & 31u);
            changed = with(changed, filter_of(w->ends[w->order[end]].solid));
            ++end;
        } while (end < w->count && (w->ends[w->order[end]].t == t || w->ends[w->order[end]].t - t <= tolerance));
        for (i = done; i < end; ++i) {
            const u32 number = w->order[i], word = number >> 6, bit = 1u << (number >> 1 & 31u);
            if (!(number & 1u)) {
                if ((w->open[word] & bit) && in_end == NONE) in_end = number;
            } else {
                if (!(w->open[word] & bit) && (before[word] & bit) && out_end == NONE) out_end = number;
                w->used[word] &= ~bit;
            }
        }
        done = end;
        if (in_end == NONE && out_end == NONE) continue;
        // What ends before t_min is not seen.
        if (w->region != NONE && t > t_min) {
            found = 1;
        } else {
            if (w->region != NONE) changed = all_solids();
            w->region = first_claim(w, s, changed);
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

#define RAY_MISSES 0u
#define RAY_HITS 1u
#define RAY_OVERFLOWS 2u

// About where the first event is complete.
FN float due_at(const front* w, real tolerance, wide offset) {
    return w->count > 0 ? (float)((wide)(w->ends[w->order[0]].t + tolerance) - offset) : BOX_MISSED;
}

// `next`: the nodes of the ray's block.
FN u32 first_hit(GLOBAL const Frame* f, scene_tables s, GLOBAL const BlockNode* next, ray3 r, front* w) {
    const real t_min = t_min_along(f, r), tolerance = tolerance_along(f, r);
    const slab_ray slabs = make_slab_ray(offset_from(frame_center(f), r.o), r.d, REAL(f->radius), t_min);
    const wide offset = offset_along(f, r);
    u32 solid = 0, end = f->unbounded_count, i = 0, subtree_end = 0, leaf;
    w->count = w->from_within = 0;
    for (i = 0; i < SLOT_WORDS; ++i) w->used[i] = w->open[i] = w->starts[i] = 0;
    i = 0;
    w->region = NONE;
    // All rays of a block come to the next of its nodes together, so that work-items in lockstep test the same solids.
    for (;;) {
        BlockNode e;
        for (;;) {
            for (; solid < end; ++solid)
                if (!take_solid(w, s.g, solid, r, t_min)) return RAY_OVERFLOWS;
            leaf = next_leaf(slabs, s.nodes, &i, subtree_end);
            if (!leaf) break;
            solid = leaf >> BVH_LEAF_SHIFT;
            end = solid + (leaf & BVH_LEAF_MASK);
        }
        e = *next++;
        if (e.entry > due_at(w, tolerance, offset) || e.node == NONE) {
            const real horizon = e.node == NONE ? REAL_INFINITY : REAL((wide)e.entry + offset);
            if (advance(w, s, tolerance, t_min, horizon)) return RAY_HITS;
            if (e.node == NONE) return RAY_MISSES;
        }
        i = subtree_end = 0;
        if (slabs.hits_sphere) {
            i = e.node;
            subtree_end = s.nodes[i].skip;
        }
    }
}

#endif
