// Solids whose boxes a packet's rays meet, on their way to being met themselves.
//
// Of a scene that the processor's caches do not hold, each solid's numbers come from far: its record, then what that points to, then
// what stands there. So several solids wait until what they need is asked for (CSGRT_PREFETCH); else none does.
#ifndef CSGRT_PACKET_PENDING_SOLIDS_H
#define CSGRT_PACKET_PENDING_SOLIDS_H

#include "solids.h"
#include "../shading/pixel.h"

#ifdef CSGRT_PREFETCH

#define ENOUGH_PENDING 8u  // solids that are enough to begin with
#define MOST_PENDING 24u   // that there is room for

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

// What its record, which was asked for, points to.
FN void prefetch_solid(scene_tables s, u32 index) {
    GLOBAL const SolidRecord* const solid = s.g.solids + index;
    prefetch_line(s.starts + solid->first_start);
    prefetch_line(s.g.reals + solid->first_real);
    prefetch_line(s.g.reals + solid->first_real + 8);
    prefetch_line(s.g.reals + solid->first_real + 16);
    prefetch_line(s.g.plane_refs + solid->first_plane);
}

// What that points to.
FN void prefetch_parts(scene_tables s, u32 index) {
    GLOBAL const SolidRecord* const solid = s.g.solids + index;
    if (solid->start_count) prefetch_line(s.trees + s.starts[solid->first_start].first_word);
    if (solid->plane_count) {
        GLOBAL const PlaneRef* const refs = s.g.plane_refs + solid->first_plane;
        prefetch_line(s.g.planes + (refs[0] >> 1));
        prefetch_line(s.g.planes + (refs[solid->plane_count / 2] >> 1));
        prefetch_line(s.g.planes + (refs[solid->plane_count - 1] >> 1));
    }
}

// Of the rays of the hit mask: what their regions, which were asked for, are made of.
FN void prefetch_materials(const packet* p, appearance_tables a, u32 hit_mask) {
    for (; hit_mask; hit_mask &= hit_mask - 1u) prefetch_line(a.materials + a.regions[p->sweeps[lowest(hit_mask)].region].material);
}

FN void start_pending(pending_solids* pending) { pending->count = 0; }
FN int are_enough(const pending_solids* pending) { return pending->count >= ENOUGH_PENDING; }

// The rays take up the solids that wait. Returns the overflow mask.
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

// The active rays take a solid up, or have it wait. Returns the overflow mask of what waited.
FN u32 take_or_defer(packet* p, scene_tables s, u32 index, u32 active_mask, pending_solids* pending) {
    const u32 overflow_mask = pending->count == MOST_PENDING ? take_pending(p, s, pending) : 0;
    prefetch_line(s.g.solids + index);
    pending->solids[pending->count] = index;
    pending->rays[pending->count++] = active_mask;
    return overflow_mask;
}

#else

typedef struct {
    u32 none;
} pending_solids;

#define prefetch_node(s, node) ((void)0)
#define prefetch_materials(p, a, hit_mask) ((void)0)
#define start_pending(pending) ((void)0)
#define are_enough(pending) 1
#define take_pending(p, s, pending) 0u
#define take_or_defer(p, s, index, active_mask, pending) take_solid_by_packet(p, (s).g, index, active_mask)

#endif

#endif
