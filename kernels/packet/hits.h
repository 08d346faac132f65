// The first claimed partitions of a packet's rays: boolean/first_hit.h's work, but the rays go through their tile's nodes together. Each
// ray's events are its own.
//
// Some of the rays (`which`, `lost`, `hit`) are a word whose bit k stands for ray k.
#ifndef CSGRT_PACKET_HITS_H
#define CSGRT_PACKET_HITS_H

#include "pending_solids.h"

// The rays among `which` that meet what a subtree holds take it up, or have it wait. Returns those that have no room.
FN u32 take_subtree(packet* p, scene_tables s, u32 root, u32 which, pending_solids* pending) {
    bvh_cursor cursor = bvh_below(s.nodes, root);
    u32 lost = 0, hit, leaf;
    while ((leaf = next_leaf(p->slabs, s.nodes, &cursor, which, &hit))) {
        const u32 first = leaf >> BVH_LEAF_SHIFT, last = first + (leaf & BVH_LEAF_MASK);
        u32 solid;
        for (solid = first; solid < last; ++solid) lost |= take_or_defer(p, s, solid, hit & ~lost, pending);
    }
    return lost;
}

// Of the rays of `which`, those whose first seen partition is known; `lost`: those that hold more than there is room for.
FN u32 first_hits_of(packet* p, __global const Frame* f, scene_tables s, __global const RegionRecord* regions,
                     __global const TileNode* next, u32 which, u32* lost) {
    const u32 near_scene = bits_of(p->slabs.hits_sphere);
    u32 hit = 0, k;
    TileNode e;
    pending_solids pending;
    start_pending(&pending);
    *lost = 0;
    for (k = 0; k < f->unbounded_count; ++k) *lost |= take_solid_by_packet(p, s.g, k, which & ~*lost);
    do {
        u32 going;
        real horizon;
        e = *next++;
        horizon = e.node == NONE ? REAL_INFINITY : (wide)e.entry + p->offset;
        // Which have events that nothing in this node can join; behind the last one all do, or stay in what they are in.
        going = (e.node == NONE ? which : bits_of(vload8(0, p->due) < e.entry)) & which & ~*lost & ~hit;
        for (; going; going &= going - 1u) {
            front* w = p->fronts + lowest(going);
            if (advance(w, s, p->tolerance, p->t_min, horizon)) {
                hit |= going & (0u - going);
                fetch(regions + w->region);
            }
            p->due[lowest(going)] = due_at(w, p->tolerance, p->offset);
        }
        going = which & ~*lost & ~hit & near_scene;
        if (e.node != NONE && going) {
            fetch_node(s, next->node);
            *lost |= take_subtree(p, s, e.node, going, &pending);
        }
        // What comes later may be taken up sooner, as long as no ray has an event to pass meanwhile.
        while (!are_enough(&pending) && e.node != NONE && next->node != NONE && !(bits_of(vload8(0, p->due) < next->entry) & going)) {
            fetch_node(s, next[1].node);
            if (going & ~*lost) *lost |= take_subtree(p, s, next->node, going & ~*lost, &pending);
            ++next;
        }
        *lost |= take_pending(p, s, &pending);
    } while (e.node != NONE && (which & ~*lost & ~hit));
    return hit;
}

#endif
