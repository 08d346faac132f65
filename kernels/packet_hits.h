// The first claimed partitions of a packet's rays: first_hit.h's work, but the rays go through their block's nodes together and
// the closed-form solids are put to all of them at once. Each ray's events are its own.
//
// Some of the rays (`which`, `lost`, `hit`) are a word whose bit k stands for ray k.
#ifndef CSGRT_PACKET_HITS_H
#define CSGRT_PACKET_HITS_H

#include "first_hit.h"
#include "packet.h"

// The rays of a packet on their way through the scene.
typedef struct {
    packet_ray3 rays;
    packet_lanes lanes;
    packet_slab_ray slabs;
    real t_min, tolerance;
    wide offset;  // of distances in the block's list
    float due[PACKET];  // about where the first event of each is complete
    front fronts[PACKET];
} packet;

// What the rays of `which` meet of a solid. Returns those that have no room for it.
FN u32 take_solid_by_packet(packet* p, Geometry g, u32 index, u32 which) {
    const SolidRecord solid = g.solids[index];
    u32 alone = which, lost = 0;
    if ((which & (which - 1u)) && takes_packets(solid)) {
        const packet_hits h = packet_intersect(g, solid, p->rays);
        u32 found = bits_of(h.count == 1 && h.out0 >= p->t_min) & which;
        alone &= bits_of(h.count == UNDECIDED);
        if (found) {
            real in[PACKET], out[PACKET];
            ulong in_surface[PACKET], out_surface[PACKET];
            vstore8(h.in0, 0, in);
            vstore8(h.out0, 0, out);
            vstore8(h.in0_surface, 0, in_surface);
            vstore8(h.out0_surface, 0, out_surface);
            for (; found; found &= found - 1u) {
                const u32 k = lowest(found);
                End ends[2];
                put_segment(ends, index, in[k], (u32)in_surface[k], out[k], (u32)out_surface[k]);
                if (!take_segment(p->fronts + k, solid, ends[0], ends[1])) lost |= 1u << k;
                p->due[k] = due_at(p->fronts + k, p->tolerance, p->offset);
            }
        }
    }
    for (; alone; alone &= alone - 1u) {
        const u32 k = lowest(alone);
        if (!take_solid(p->fronts + k, g, index, lane(&p->lanes, k), p->t_min)) lost |= 1u << k;
        p->due[k] = due_at(p->fronts + k, p->tolerance, p->offset);
    }
    return lost;
}

// The rays among `which` that meet what a subtree holds take it up. Returns those that have no room for it.
FN u32 take_subtree(packet* p, scene_tables s, u32 root, u32 which) {
    const u32 end = s.nodes[root].skip;
    u32 i = root, lost = 0, hit, leaf;
    while ((leaf = next_leaf(p->slabs, s.nodes, &i, end, which, &hit))) {
        const u32 first = leaf >> BVH_LEAF_SHIFT, last = first + (leaf & BVH_LEAF_MASK);
        u32 solid;
        for (solid = first; solid < last; ++solid) lost |= take_solid_by_packet(p, s.g, solid, hit & ~lost);
    }
    return lost;
}

// Of the rays of `which`, those whose first seen partition is known; `lost`: those that hold more than there is room for.
FN u32 first_hits_of(packet* p, __global const Frame* f, scene_tables s, __global const BlockNode* next, u32 which,
                     u32* lost) {
    const u32 near_scene = bits_of(p->slabs.hits_sphere);
    u32 hit = 0, k;
    BlockNode e;
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
            if (advance(w, s, p->tolerance, p->t_min, horizon)) hit |= going & (0u - going);
            p->due[lowest(going)] = due_at(w, p->tolerance, p->offset);
        }
        going = which & ~*lost & ~hit & near_scene;
        if (e.node != NONE && going) *lost |= take_subtree(p, s, e.node, going);
    } while (e.node != NONE && (which & ~*lost & ~hit));
    return hit;
}

#endif
