// The walk through the bounding volume hierarchy that finds a ray's candidates: the solids that it may meet.
//
// Nodes stand in depth-first order and know where to go on when their box is missed: no stack. Solids are numbered in
// the order of the leaves, so a ray's candidates, and later its segments, come out sorted by solid. Every hit along the ray
// is wanted, so the order of distance does not matter here.
#ifndef CSGRT_TRAVERSE_H
#define CSGRT_TRAVERSE_H

#include "camera.h"
#include "shared/slab.h"

// Returns how many candidates the ray has; stores them from `candidates` on unless that is 0.
FN u32 walk(GLOBAL const Frame* f, GLOBAL const BvhNode* nodes, ray3 r, u32 ray, GLOBAL Candidate* candidates) {
    slab_ray s = make_slab_ray(offset_from(frame_center(f), r.o), r.d, REAL(f->radius), t_min_along(f, r));
    u32 count = 0, i = 0, first = 0, end = f->unbounded_count;
    for (;;) {
        for (; first < end; ++first, ++count)
            if (candidates) {
                Candidate c;
                c.ray = ray;
                c.solid = first;
                c.count = c.before = 0;
                candidates[count] = c;
            }
        if (!s.hits_sphere) return count;
        for (;;) {
            BvhNode node;
            if (i >= f->node_count) return count;
            node = nodes[i];
            if (!box_is_hit(s, node)) {
                i = node.skip;
            } else if (node.leaf) {
                i = node.skip;
                first = node.leaf >> BVH_LEAF_SHIFT;
                end = first + (node.leaf & BVH_LEAF_MASK);
                break;
            } else {
                ++i;
            }
        }
    }
}

#endif
