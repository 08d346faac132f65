// Pending solids: solids whose boxes a packet's rays hit, and whose segments are not added yet.
//
// In a scene that is larger than the processor's caches, a solid's numbers come from memory in three steps: its record,
// the data that the record points to, and the data that these point to. So several solids are kept pending while their
// memory is prefetched (CSGRT_PREFETCH). In other scenes no solid is kept.
#ifndef CSGRT_PACKET_PENDING_SOLIDS_H
#define CSGRT_PACKET_PENDING_SOLIDS_H

#include "solids.h"
#include "../shading/pixel.h"

#ifdef CSGRT_PREFETCH

#define ENOUGH_PENDING 8u  // solids whose prefetches hide each other's time
#define MOST_PENDING 24u   // space for these, and for the solids of one more leaf

typedef struct {
    u32 solids[MOST_PENDING], rays[MOST_PENDING];
    u32 count;
} pending_solids;

FN void prefetch_node(scene_tables s, u32 node) {
    if (node == NONE) return;
    prefetch_line(s.nodes + node);
    prefetch_line(s.nodes + node + 2);
    prefetch_line(s.nodes + node + 4);
}

// Prefetches the data that the solid's record points to. The record was prefetched before.
FN void prefetch_solid(scene_tables s, u32 index) {
    GLOBAL const SolidRecord* const solid = s.g.solids + index;
    prefetch_line(s.starts + solid->first_start);
    prefetch_line(s.g.reals + solid->first_real);
    prefetch_line(s.g.reals + solid->first_real + 8);
    prefetch_line(s.g.reals + solid->first_real + 16);
    prefetch_line(s.g.words + solid->first_plane);
}

// Prefetches the data that the solid's starts and planes point to.
FN void prefetch_parts(scene_tables s, u32 index) {
    GLOBAL const SolidRecord* const solid = s.g.solids + index;
    if (solid->start_count) prefetch_line(s.trees + s.starts[solid->first_start].first_word);
    if (solid->plane_count) {
        GLOBAL const PlaneRef* const refs = s.g.words + solid->first_plane;
        prefetch_line(s.g.planes + (refs[0] >> 1));
        prefetch_line(s.g.planes + (refs[solid->plane_count / 2] >> 1));
        prefetch_line(s.g.planes + (refs[solid->plane_count - 1] >> 1));
    }
}

FN void start_pending(pending_solids* pending) { pending->count = 0; }
FN int are_enough(const pending_solids* pending) { return pending->count >= ENOUGH_PENDING; }

// Adds the pending solids to their rays' sweeps. Returns the overflow mask.
FN u32 take_pending(packet* p, scene_tables s, pending_solids* pending) {
    u32 i, overflow_mask = 0;
    for (i = 0; i < pending->count && i < 2; ++i) prefetch_solid(s, pending->solids[i]);
    for (i = 0; i < pending->count; ++i) {
        if (i + 2 < pending->count) prefetch_solid(s, pending->solids[i + 2]);
        if (i + 1 < pending->count) prefetch_parts(s, pending->solids[i + 1]);
        overflow_mask |= take_solid_by_packet(p, s.g, pending->solids[i], pending->rays[i] & ~overflow_mask);
    }
    pending->count = 0;
    return overflow_mask;
}

// Makes a solid pending for the active rays. If the list is full, the other solids are added first. Returns the
// overflow mask.
FN u32 take_or_defer(packet* p, scene_tables s, u32 index, u32 active_mask, pending_solids* pending) {
    const u32 overflow_mask = pending->count == MOST_PENDING ? take_pending(p, s, pending) : 0;
    prefetch_line(s.g.solids + index);
    pending->solids[pending->count] = index;
    pending->rays[pending->count++] = active_mask;
    return overflow_mask;
}

#else

typedef struct {
    u32 unused;
} pending_solids;

#define prefetch_node(s, node) ((void)0)
#define start_pending(pending) ((void)0)
#define are_enough(pending) 1
#define take_pending(p, s, pending) 0u
#define take_or_defer(p, s, index, active_mask, pending) take_solid_by_packet(p, (s).g, index, active_mask)

#endif

#endif
