// Hits: finds the first claimed partitions of a packet's rays, as boolean/first_hit.h does for one ray. The rays go
// through their tile's nodes together, and each ray passes its own events.
//
// Masks of rays are as in packet/solids.h; the hit mask stands for the rays that hit a box, or whose first hit is
// known.
#ifndef CSGRT_PACKET_HITS_H
#define CSGRT_PACKET_HITS_H

#include "pending_solids.h"

// Adds the solids of a subtree's leaves to the active rays that hit the leaves, or keeps these solids pending. Returns
// the overflow mask.
FN u32 take_subtree(packet* p, scene_tables s, u32 root, u32 active_mask, pending_solids* pending) {
    bvh_cursor cursor = bvh_below(s.nodes, root);
    u32 overflow_mask = 0, hit_mask, leaf;
    while ((leaf = next_leaf(p->slabs, s.nodes, &cursor, active_mask, &hit_mask))) {
        const u32 first = leaf >> BVH_LEAF_SHIFT, last = first + (leaf & BVH_LEAF_MASK);
        u32 solid;
        for (solid = first; solid < last; ++solid)
            overflow_mask |= take_or_defer(p, s, solid, hit_mask & ~overflow_mask, pending);
    }
    return overflow_mask;
}

// Finds the first hits of the active rays. Returns the hit mask; *overflow_mask: the rays without an answer.
FN u32 first_hits_of(packet* p, __global const Frame* f, scene_tables s, __global const MaterialRecord* materials,
                     __global const TileNode* next, u32 active_mask, u32* overflow_mask) {
    const u32 near_scene = bits_of(p->slabs.hits_sphere);
    u32 hit_mask = 0, k;
    TileNode e;
    pending_solids pending;
    start_pending(&pending);
    *overflow_mask = 0;
    for (k = 0; k < f->unbounded_count; ++k)
        *overflow_mask |= take_solid_by_packet(p, s.g, k, active_mask & ~*overflow_mask);
    do {
        u32 going;
        e = *next++;
        // Rays whose next event no solid of this node can join. Behind the last node these are all rays.
        going = (e.node == NONE ? active_mask : bits_of(vload8(0, p->next_events) < e.entry)) & active_mask &
                ~*overflow_mask & ~hit_mask;
        for (; going; going &= going - 1u) {
            sweep* w = p->sweeps + lowest(going);
            const sweep_units r = p->units[lowest(going)];
            const real horizon = e.node == NONE ? REAL_INFINITY : ((wide)e.entry + r.offset) * r.per_unit;
            if (advance(w, s, r.tolerance, r.after, horizon)) {
                hit_mask |= going & (0u - going);
                prefetch_line(materials + w->region);
            }
            p->next_events[lowest(going)] = next_event_of(p, lowest(going));
        }
        going = active_mask & ~*overflow_mask & ~hit_mask & near_scene;
        if (e.node != NONE && going) {
            prefetch_node(s, next->node);
            *overflow_mask |= take_subtree(p, s, e.node, going, &pending);
        }
        // Solids of later nodes are added together with the pending solids, as long as no ray has an event before these
        // nodes.
        while (!are_enough(&pending) && e.node != NONE && next->node != NONE &&
               !(bits_of(vload8(0, p->next_events) < next->entry) & going)) {
            prefetch_node(s, next[1].node);
            if (going & ~*overflow_mask)
                *overflow_mask |= take_subtree(p, s, next->node, going & ~*overflow_mask, &pending);
            ++next;
        }
        *overflow_mask |= take_pending(p, s, &pending);
    } while (e.node != NONE && (active_mask & ~*overflow_mask & ~hit_mask));
    return hit_mask;
}

#endif
