// The walk through the bounding volume hierarchy that finds a ray's candidates: the solids that it may meet.
//
// Nodes stand in depth-first order and know where to go on when their box is missed: no stack. Solids are numbered in
// the order of the leaves, so a ray's candidates, and later its segments, come out sorted by solid. Every hit along the ray
// is wanted, so the order of distance does not matter here.
#ifndef CSGRT_TRAVERSAL_CANDIDATES_H
#define CSGRT_TRAVERSAL_CANDIDATES_H

#include "camera.h"
#include "../shared/slab.h"

// Steps to the next leaf that the ray meets among the nodes from *i on. Returns its solids as BvhNode has them, 0 if `end`
// comes first; *i stands behind it then.
FN u32 next_leaf(slab_ray s, GLOBAL const BvhNode* nodes, u32* i, u32 end) {
    u32 leaf = 0;
    while (!leaf && *i < end) {
        const BvhNode node = nodes[*i];
        const int hit = box_is_hit(s, node);
        leaf = hit ? node.leaf : 0;
        *i = hit && !node.leaf ? *i + 1 : node.skip;
    }
    return leaf;
}

// Returns how many candidates the ray has; stores them from `candidates` on unless that is 0. `next`: the nodes that the
// ray's tile meets, as they stand in the hierarchy; 0: there is no such list.
FN u32 walk(GLOBAL const Frame* f, GLOBAL const BvhNode* nodes, GLOBAL const TileNode* next, ray3 r, u32 ray,
            GLOBAL Candidate* candidates) {
    const slab_ray s = make_slab_ray(offset_from(frame_center(f), r.o), r.d, REAL(f->radius), t_min_along(f, r));
    u32 count = 0, i = 0, last = s.hits_sphere && !next ? f->node_count : 0, solid = 0, end = f->unbounded_count;
    for (;;) {
        u32 leaf;
        for (; solid < end; ++solid, ++count)
            if (candidates) {
                Candidate c;
                c.ray = ray;
                c.solid = solid;
                c.count = UNCOUNTED;
                c.before = 0;
                candidates[count] = c;
            }
        leaf = next_leaf(s, nodes, &i, last);
        while (!leaf && next && s.hits_sphere && next->node != NONE) {
            i = (next++)->node;
            last = nodes[i].skip;
            leaf = next_leaf(s, nodes, &i, last);
        }
        if (!leaf) return count;
        solid = leaf >> BVH_LEAF_SHIFT;
        end = solid + (leaf & BVH_LEAF_MASK);
    }
}

#endif
