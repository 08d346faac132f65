// Kernel 0: which blocks of a picture can see anything at all; the rays of the others are never made. And which leaves of
// the hierarchy each of them meets, from front to back: found once for 64 rays, which are put to little else.
#include "blocks.h"

// Keeps the nearest leaves in order, and before what distance none is missing.
static void list_leaf(__global BlockLeaf* list, u32 count, BlockLeaf leaf) {
    u32 i = count;
    if (i == LISTED_LEAVES - 1) {
        const BlockLeaf last = list[i - 1];
        if (leaf.entry >= last.entry) {
            list[i].entry = fmin(list[i].entry, leaf.entry);
            return;
        }
        list[i].entry = fmin(list[i].entry, last.entry);
        --i;
    } else {
        list[i + 1] = list[i];
    }
    for (; i > 0; --i) {
        const BlockLeaf before = list[i - 1];
        if (before.entry <= leaf.entry) break;
        list[i] = before;
    }
    list[i] = leaf;
}

// A work-item is a block: 1 if one of its rays may meet a solid. `leaves`: LISTED_LEAVES a block; 0: they are not wanted.
__kernel void cull_blocks(__global const Frame* frame, __global const BvhNode* nodes, __global unsigned char* blocks,
                          __global BlockLeaf* leaves) {
    u32 id = (u32)get_global_id(0), i = 0, count = 0;
    BlockLeaf end;
    beam b;
    if (id >= frame->ray_count / (BLOCK * BLOCK)) return;
    end.node = NONE;
    end.entry = BOX_MISSED;
    if (leaves) {
        leaves += (size_t)id * LISTED_LEAVES;
        leaves[0] = end;
    }
    b = make_beam(frame, frame->first_ray / (BLOCK * BLOCK) + id);
    while (b.slabs.hits_sphere && i < frame->node_count) {
        const BvhNode node = nodes[i];
        const float at = beam_entry(b, node);
        i = at < BOX_MISSED ? i + 1 : node.skip;
        if (at < BOX_MISSED && node.leaf) {
            if (leaves) {
                BlockLeaf leaf;
                leaf.node = i - 1;
                leaf.entry = entry_from_center(b, at);
                list_leaf(leaves, count, leaf);
            }
            if (count < LISTED_LEAVES - 1) ++count;
            if (!leaves) break;
        }
    }
    blocks[id] = count > 0 || frame->unbounded_count > 0;
}
