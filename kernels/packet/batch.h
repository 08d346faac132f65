// Solids whose boxes a packet's rays meet, on their way to being met themselves.
//
// Of a scene that the processor's caches do not hold, each solid's numbers come from far: its record, then what that points to, then
// what stands there. So several solids wait until what they need is asked for (CSGRT_FETCH); else none does.
#ifndef CSGRT_PACKET_BATCH_H
#define CSGRT_PACKET_BATCH_H

#include "solids.h"
#include "../shading/pixel.h"

#ifdef CSGRT_FETCH

#define BATCH 8u     // solids that are enough to begin with
#define WAITING 24u  // that there is room for

typedef struct {
    u32 solids[WAITING], rays[WAITING];
    u32 count;
} solid_batch;

FN void fetch_node(scene_tables s, u32 node) {
    if (node == NONE) return;
    fetch(s.nodes + node);
    fetch(s.nodes + node + 2);
    fetch(s.nodes + node + 4);
}

// What its record, which was asked for, points to.
FN void fetch_solid(scene_tables s, u32 index) {
    GLOBAL const SolidRecord* const solid = s.g.solids + index;
    fetch(s.starts + solid->first_start);
    fetch(s.g.reals + solid->first_real);
    fetch(s.g.reals + solid->first_real + 8);
    fetch(s.g.reals + solid->first_real + 16);
    fetch(s.g.words + solid->first_plane);
}

// What that points to.
FN void fetch_parts(scene_tables s, u32 index) {
    GLOBAL const SolidRecord* const solid = s.g.solids + index;
    if (solid->start_count) fetch(s.trees + s.starts[solid->first_start].first_word);
    if (solid->plane_count) {
        GLOBAL const PlaneRef* const refs = s.g.words + solid->first_plane;
        fetch(s.g.planes + (refs[0] >> 1));
        fetch(s.g.planes + (refs[solid->plane_count / 2] >> 1));
        fetch(s.g.planes + (refs[solid->plane_count - 1] >> 1));
    }
}

FN void start_batch(solid_batch* b) { b->count = 0; }
FN int is_enough(const solid_batch* b) { return b->count >= BATCH; }

// The rays take up the solids that wait. Returns those that have no room.
FN u32 take_batch(packet* p, scene_tables s, solid_batch* b) {
    u32 i, lost = 0;
    for (i = 0; i < b->count && i < 2; ++i) fetch_solid(s, b->solids[i]);
    for (i = 0; i < b->count; ++i) {
        if (i + 2 < b->count) fetch_solid(s, b->solids[i + 2]);
        if (i + 1 < b->count) fetch_parts(s, b->solids[i + 1]);
        lost |= take_solid_by_packet(p, s.g, b->solids[i], b->rays[i] & ~lost);
    }
    b->count = 0;
    return lost;
}

// The rays of `which` take a solid up, or have it wait. Returns those that have no room for what waited.
FN u32 take_or_wait(packet* p, scene_tables s, u32 index, u32 which, solid_batch* b) {
    const u32 lost = b->count == WAITING ? take_batch(p, s, b) : 0;
    fetch(s.g.solids + index);
    b->solids[b->count] = index;
    b->rays[b->count++] = which;
    return lost;
}

#else

typedef struct {
    u32 none;
} solid_batch;

#define fetch_node(s, node) ((void)0)
#define start_batch(b) ((void)0)
#define is_enough(b) 1
#define take_batch(p, s, b) 0u
#define take_or_wait(p, s, index, which, b) take_solid_by_packet(p, (s).g, index, which)

#endif

#endif
