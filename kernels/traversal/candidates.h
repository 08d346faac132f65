// Candidates: the walk through the bounding volume hierarchy that finds the solids that a ray may meet.
//
// Solids are numbered in the order of the leaves, so a ray's candidates, and later its segments, come out sorted by
// solid. Every segment along the ray is wanted, so the order of distance does not matter here.
#ifndef CSGRT_TRAVERSAL_CANDIDATES_H
#define CSGRT_TRAVERSAL_CANDIDATES_H

#include "bvh_cursor.h"
#include "camera.h"

// Steps past the next leaf that the ray enters before `end`, as next_leaf does.
FN u32 next_leaf_before(slab_ray s, single end, GLOBAL const BvhNode* nodes, bvh_cursor* c) {
    u32 leaf = 0;
    while (!leaf && bvh_goes_on(*c)) {
        const BvhNode node = nodes[c->node];
        leaf = bvh_step(c, node, box_is_hit_before(s, node, end));
    }
    return leaf;
}

// Returns how many candidates the ray has; stores them from `candidates` on unless `candidates` is 0. `next`: the nodes
// that the ray's tile meets, in the hierarchy's order; 0: there is no such list.
FN u32 walk(GLOBAL const Frame* f, GLOBAL const BvhNode* nodes, GLOBAL const TileNode* next, ray3 r, ray_range wanted,
            u32 ray, GLOBAL Candidate* candidates) {
    const ray_range within = range_of_boxes(f, wanted);
    const slab_ray s = make_slab_ray(offset_from(frame_center(f), r.o), r.d, REAL(f->radius), within.t_min);
    const single range_end = end_of_range(s, REAL(f->radius), within.t_max);
    bvh_cursor cursor = bvh_over(s.hits_sphere && !next ? f->node_count : 0);
    u32 count = 0, solid = 0, end = f->unbounded_count;
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
        leaf = next_leaf_before(s, range_end, nodes, &cursor);
        while (!leaf && next && s.hits_sphere && next->node != NONE) {
            cursor = bvh_below(nodes, (next++)->node);
            leaf = next_leaf_before(s, range_end, nodes, &cursor);
        }
        if (!leaf) return count;
        solid = leaf >> BVH_LEAF_SHIFT;
        end = solid + (leaf & BVH_LEAF_MASK);
    }
}

#endif
