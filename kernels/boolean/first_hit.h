// First hit: finds the first claimed partition of a ray, and no other, from front to back, in private memory.
//
// The list of the ray's tile has the nearest nodes first (kernel 0). Solids that are not intersected yet begin at the
// next node's distance or behind it. So every event before this distance is complete: no segment can join the event.
// Complete events are passed, and their partitions evaluated, as in kernels 3 and 4. The first claim ends the search.
// Slots of segments that have ended are used again. A ray with more than SWEEP_SEGMENTS segments at a time overflows,
// and kernels 1 to 5 trace it instead.
//
//   nodes      |--seen--|   |--seen--|      |--unseen--|
//   boundaries  i     o  i    i   o         :       o  o
//   events      1     2  3    4   5         : others may still join these
#ifndef CSGRT_BOOLEAN_FIRST_HIT_H
#define CSGRT_BOOLEAN_FIRST_HIT_H

#include "../traversal/beam.h"
#include "claim.h"
#include "../geometry/collect.h"
#include "../traversal/bvh_cursor.h"

#define SWEEP_SEGMENTS FEW                 // segments that a ray holds at a time
#define SLOT_WORDS (SWEEP_SEGMENTS / 32u)  // words of a bit array with a bit for each segment

// The state of the sweep along a ray: the segments that have begun or will begin. The next boundary of a segment is
// `in` if the segment is not open yet, else `out`.
typedef struct {
    Boundary boundaries[2 * SWEEP_SEGMENTS];  // of segment s: 2 s and 2 s + 1
    u32 used[SLOT_WORDS];                     // bit s: there is a segment s
    u32 open[SLOT_WORDS];                     // bit s: it covers the partition that the sweep is in
    u32 starts[SLOT_WORDS];                   // bit s: its solid starts some term
    u32 entry[SLOT_WORDS];                    // bit s: some term may begin to be true where segment s begins
    u32 exit[SLOT_WORDS];                     // bit s: some term may begin to be true where segment s ends
    real next_event;                          // the distance of the next boundary; infinity: there is none
    Boundary seen;                            // the boundary where the current partition begins, if it is claimed
    u32 region;                               // the region that claims the current partition, or NONE
    u32 from_within;                          // the partition begins where a solid ends
    u32 goes_on;                              // the same region claims the partition before the current one
    u32 marked;                               // has any segment so far MISSED_... set?
    u32 beyond;                               // see cover
} sweep;

// The tables of a scene that first hits need.
typedef struct {
    Geometry g;
    GLOBAL const BvhNode* nodes;
    GLOBAL const StartRecord* starts;
    GLOBAL const u32* trees;
#if SHAPED_LIGHTS
    u32 seen_end;  // the number after the last region that pictures show
#endif
} scene_tables;

FN void start_sweep(sweep* w) {
    u32 i;
    for (i = 0; i < SLOT_WORDS; ++i) w->used[i] = w->open[i] = w->starts[i] = w->entry[i] = w->exit[i] = 0;
    w->from_within = w->goes_on = w->marked = w->beyond = 0;
    w->region = NONE;
    w->next_event = REAL_INFINITY;
}

// Returns a free slot for one more segment; NONE: there is none.
FN u32 take_slot(sweep* w, SolidRecord solid) {
    u32 i, slot = NONE;
    for (i = 0; i < SLOT_WORDS && slot == NONE; ++i) {
        const u32 bit = ~w->used[i] & (w->used[i] + 1u);
        if (bit) {
            w->used[i] |= bit;
            w->starts[i] = (w->starts[i] & ~bit) | (solid.start_count ? bit : 0);
            w->entry[i] = (w->entry[i] & ~bit) | (solid.begins & BEGINS_AT_ENTRY ? bit : 0);
            w->exit[i] = (w->exit[i] & ~bit) | (solid.begins & BEGINS_AT_EXIT ? bit : 0);
            slot = 32u * i + 31u - clz(bit);
        }
    }
    return slot;
}

// Adds a segment. Returns 0 if no slot is free.
FN int take_segment(sweep* w, SolidRecord solid, Boundary in, Boundary out) {
    const u32 slot = take_slot(w, solid);
    if (slot != NONE) {
        w->marked |= in.surface & MISSED;
        w->boundaries[2 * slot] = in;
        w->boundaries[2 * slot + 1] = out;
        w->next_event = real_min(w->next_event, in.t);
    }
    return slot != NONE;
}

// Adds the solid's segments. Returns 0 if there are not enough free slots.
FN int take_solid(sweep* w, Geometry g, u32 index, ray3 r, real t_min) {
    SolidRecord solid = g.solids[index];
    u32 count, i;
    int fits = 1;
#if (CSGRT_SOLIDS) & MANY_SEGMENTS
    Boundary found[2 * SWEEP_SEGMENTS];
    if ((MANY_SEGMENTS >> solid.type & 1u) &&
        collect(g, solid, index, r, t_min, (BOUNDARY_SPACE Boundary*)0) > SWEEP_SEGMENTS)
        return 0;
#else
    Boundary found[4];
#endif
    count = collect(g, solid, index, r, t_min, found);
    for (i = 0; i < count && fits; ++i) fits = take_segment(w, solid, found[2 * i], found[2 * i + 1]);
    return fits;
}

// The claim where one segment alone covers; ALONE_UNKNOWN: several cover, or the solid's terms have to be evaluated.
FN u32 claim_of_one(const sweep* w, scene_tables s) {
    u32 i, several = w->beyond, slot = NONE;
    for (i = 0; i < SLOT_WORDS; ++i) {
        const u32 bits = w->open[i];
        several |= bits & (bits - 1u);
        several |= bits && slot != NONE;
        slot = bits ? 32u * i + 31u - clz(bits) : slot;
    }
    return several || slot == NONE ? ALONE_UNKNOWN : s.g.solids[w->boundaries[2 * slot].solid].alone;
}

// The region that claims the space that the open segments cover. NONE also if the region is hidden: hidden regions have
// the last numbers, so no other region claims.
FN u32 first_claim(const sweep* w, scene_tables s, SolidFilter changed) {
    u32 starting[SLOT_WORDS], i, any = 0, alone, region;
    for (i = 0; i < SLOT_WORDS; ++i) any |= starting[i] = w->open[i] & w->starts[i];
    alone = any ? claim_of_one(w, s) : NONE;
    region = alone & ~OVERLAP;
    if (alone == ALONE_UNKNOWN) {
        cover c;
        covered_solids covered;
        c.boundaries = w->boundaries;
        c.bits = w->open;
        c.segments = SWEEP_SEGMENTS;
        c.missed = 0;
        c.marked = w->marked;
        c.beyond = w->beyond;
        c.solids = s.g.solids;
        c.starts = s.starts;
        c.trees = s.trees;
        list_covered(c, &covered);
        region = find_claim_beside(c, starting, &covered, 0, changed).least;
    }
#if SHAPED_LIGHTS
    region = region < s.seen_end ? region : NONE;
#endif
    return region;
}

// The order in which kernel 3 links boundaries: by distance, then by solid.
FN int comes_before(Boundary a, Boundary b) { return a.t < b.t || (a.t == b.t && a.solid < b.solid); }

// An event: the first boundary where a segment begins to cover, and the first where a segment ceases to.
typedef struct {
    Boundary in, out;     // solid NONE: there is none
    SolidFilter changed;  // the solids that begin or cease to cover
    u32 begins;           // not 0: a term may begin to be true
} event;

// Passes the next event: the boundaries at w->next_event, and the boundaries within the tolerance behind it.
FN event pass_event(sweep* w, real tolerance) {
    const real t = w->next_event;
    u32 word;
    event e;
    e.in.t = e.out.t = w->next_event = REAL_INFINITY;
    e.in.solid = e.out.solid = NONE;
    e.changed.even = e.changed.odd = 0;
    e.begins = 0;
    for (word = 0; word < SLOT_WORDS; ++word) {
        u32 bits = w->used[word];
        while (bits) {
            const u32 bit = bits & (0u - bits), slot = 32u * word + 31u - clz(bit),
                      is_open = (w->open[word] & bit) != 0;
            real next = w->boundaries[2 * slot + is_open].t;
            bits ^= bit;
            if (next == t || next - t <= tolerance) {
                const Boundary end = w->boundaries[2 * slot + is_open];
                const real out = w->boundaries[2 * slot + 1].t;
                const int is_thin = !is_open && (out == t || out - t <= tolerance);
                if (is_open || is_thin) w->used[word] ^= bit;
                if (!is_thin) {
                    w->open[word] ^= bit;
                    e.changed = with(e.changed, filter_of(end.solid));
                    e.begins |= (is_open ? w->exit[word] : w->entry[word]) & bit;
                }
                if (is_open && comes_before(end, e.out)) e.out = end;
                if (!is_open && !is_thin && comes_before(end, e.in)) e.in = end;
                next = is_open || is_thin ? REAL_INFINITY : out;
            }
            w->next_event = real_min(w->next_event, next);
        }
    }
    return e;
}

// Is the next event complete, if all segments still to come begin at `horizon` or later?
FN int is_complete(const sweep* w, real tolerance, real horizon) {
    return w->next_event < REAL_INFINITY && horizon - w->next_event > tolerance;
}

// Passes all events that are complete. Returns 1 if the first visible partition is known.
FN int advance(sweep* w, scene_tables s, real tolerance, real after, real horizon) {
    int found = 0, going = is_complete(w, tolerance, horizon);
    while (going) {
        const real t = w->next_event;
        event e = pass_event(w, tolerance);
        const int matters = w->region == NONE ? e.begins != 0 : e.in.solid != NONE || e.out.solid != NONE;
        // A partition that ends at `after` or before is not seen.
        found = matters && w->region != NONE && t > after;
        if (matters && !found) {
            const u32 before = w->region;
            if (w->region != NONE) e.changed = all_solids();
            w->region = first_claim(w, s, e.changed);
            w->goes_on = before != NONE && w->region == before;
            w->from_within = e.in.solid == NONE;
            w->seen = w->from_within ? e.out : e.in;
            w->seen.t = t;
            found = w->region != NONE && t > after;
        }
        going = !found && is_complete(w, tolerance, horizon);
    }
    // After the last event, a region that claims does so up to the ray's end.
    return found || (w->region != NONE && horizon == REAL_INFINITY);
}

#define RAY_MISSES 0u
#define RAY_HITS 1u
#define RAY_OVERFLOWS 2u
#define RAY_GOES_ON 3u

// An estimate of the distance where the next event is complete, in the distances of the tile's list.
FN float event_distance(const sweep* w, real tolerance, wide offset) {
    return w->next_event < REAL_INFINITY ? (float)((wide)(w->next_event + tolerance) - offset) : BOX_MISSED;
}

// Finds the first region that is seen, and leaves it in the sweep's state. Returns RAY_HITS, RAY_MISSES or
// RAY_OVERFLOWS. `next`: the nodes of the ray's tile. Segments that end before `from` are not wanted; partitions that
// end at `after` or before are not seen. `beyond`: see cover.
FN u32 first_hit(GLOBAL const Frame* f, scene_tables s, GLOBAL const TileNode* next, ray3 r, real from, real after,
                 u32 beyond, sweep* w) {
    const real tolerance = tolerance_along(f, r);
    const slab_ray slabs = make_slab_ray(offset_from(frame_center(f), r.o), r.d, REAL(f->radius), from);
    const wide offset = offset_along(f, r);
    bvh_cursor cursor = bvh_over(0);
    u32 solid = 0, end = f->unbounded_count, leaf, result = RAY_GOES_ON;
    start_sweep(w);
    w->beyond = beyond;
    // All rays of a tile come to its next node together, so that the work-items of a warp test the same solids. Each
    // loop has one exit, here and in the functions that are called: work-items that leave a loop by several exits stay
    // divergent.
    do {
        TileNode e;
        do {
            for (; solid < end && result == RAY_GOES_ON; ++solid)
                if (!take_solid(w, s.g, solid, r, from)) result = RAY_OVERFLOWS;
            leaf = next_leaf(slabs, s.nodes, &cursor);
            solid = leaf >> BVH_LEAF_SHIFT;
            end = solid + (leaf & BVH_LEAF_MASK);
        } while (leaf);
        e = *next;
        if (e.node != NONE) ++next;
        if (result == RAY_GOES_ON && (e.entry > event_distance(w, tolerance, offset) || e.node == NONE)) {
            const real horizon = e.node == NONE ? REAL_INFINITY : REAL((wide)e.entry + offset);
            if (advance(w, s, tolerance, after, horizon)) {
                result = RAY_HITS;
            } else if (e.node == NONE) {
                result = RAY_MISSES;
            }
        }
        cursor = bvh_over(0);
        if (result == RAY_GOES_ON && slabs.hits_sphere && e.node != NONE) cursor = bvh_below(s.nodes, e.node);
    } while (result == RAY_GOES_ON);
    return result;
}

#endif
