// The walk through the bounding volume hierarchy that kernels 1 (count hits) and 2 (store segments) share: the same
// rays meet the same solids in the same order, so what was counted is what is stored.
//
// Nodes stand in depth-first order and know where to go on when their box is missed: no stack. Solids are numbered in
// the order of the leaves, so a ray's segments come out sorted by solid. Every hit along the ray is wanted, so the order
// of distance does not matter here.
#ifndef CSGRT_TRAVERSE_H
#define CSGRT_TRAVERSE_H

#include "camera.h"
#include "geometry/collect.h"
#include "shared/slab.h"

// What the walk hands on: counts, and where the next end goes (ends == 0: count only).
typedef struct {
    u32 segments;
    u32 regions;
    GLOBAL End* ends;
} walk_state;

FN walk_state meet_solid(GLOBAL const Frame* f, Geometry g, u32 index, ray3 r, walk_state w) {
    SolidRecord solid = g.solids[index];
    u32 wanted = collect(g, solid, index, r, t_min_along(f, r), w.ends);
    if (wanted) {
        if (w.ends) w.ends += 2 * wanted;
        w.segments += wanted;
        w.regions += solid.region_count;
    }
    return w;
}

FN walk_state walk(GLOBAL const Frame* f, Geometry g, GLOBAL const BvhNode* nodes, ray3 r, GLOBAL End* ends) {
    walk_state w;
    slab_ray s = make_slab_ray(offset_from(frame_center(f), r.o), r.d, REAL(f->radius), t_min_along(f, r));
    u32 i;
    w.segments = 0;
    w.regions = 0;
    w.ends = ends;
    for (i = 0; i < f->unbounded_count; ++i) w = meet_solid(f, g, i, r, w);
    if (!s.hits_sphere) return w;
    i = 0;
    while (i < f->node_count) {
        BvhNode node = nodes[i];
        if (!box_is_hit(s, node)) {
            i = node.skip;
        } else if (node.leaf) {
            u32 first = node.leaf >> BVH_LEAF_SHIFT, end = first + (node.leaf & BVH_LEAF_MASK);
            for (; first < end; ++first) w = meet_solid(f, g, first, r, w);
            i = node.skip;
        } else {
            ++i;
        }
    }
    return w;
}

#endif
