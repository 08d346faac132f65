// BVH cursor: the walk through a bounding volume hierarchy, of the scene's solids, of a mesh's triangles, or of a
// sketch's lines.
//
// Nodes are stored in depth-first order, and each node has the number of the node that follows if its box is missed. So
// a walk needs no stack. A cursor is the next node, and the number after the last node. The caller tests the boxes:
// with a ray, a packet, a beam or a line.
#ifndef CSGRT_TRAVERSAL_BVH_CURSOR_H
#define CSGRT_TRAVERSAL_BVH_CURSOR_H

#include "../shared/slab.h"

// A position in the walk: the next node, and the number after the last.
typedef struct {
    u32 node, end;
} bvh_cursor;

// A cursor over all of a hierarchy of `count` nodes; 0: over nothing.
FN bvh_cursor bvh_over(u32 count) {
    bvh_cursor c;
    c.node = 0;
    c.end = count;
    return c;
}

// A cursor over a node and all nodes below it.
FN bvh_cursor bvh_below(GLOBAL const BvhNode* nodes, u32 node) {
    bvh_cursor c;
    c.node = node;
    c.end = nodes[node].skip;
    return c;
}

FN int bvh_goes_on(bvh_cursor c) { return c.node < c.end; }

// Moves the cursor from `node` to its first child if its box is hit, else past all nodes below it. Returns BvhNode.leaf
// if a leaf is hit, else 0.
//
// The steps are branches: a processor predicts the branch and loads the next node before the box's test is done. With
// ?: it waits, and first hits of scenes/meshes.json take 1.45 times as long.
FN u32 bvh_step(bvh_cursor* c, BvhNode node, int hit) {
    if (hit && !node.leaf) {
        ++c->node;
        return 0;
    }
    c->node = node.skip;
    return hit ? node.leaf : 0;
}

// Steps past the next leaf that the ray hits, and returns it; 0: there is none.
FN u32 next_leaf(slab_ray s, GLOBAL const BvhNode* nodes, bvh_cursor* c) {
    u32 leaf = 0;
    while (!leaf && bvh_goes_on(*c)) {
        const BvhNode node = nodes[c->node];
        leaf = bvh_step(c, node, box_is_hit(s, node));
    }
    return leaf;
}

#endif
