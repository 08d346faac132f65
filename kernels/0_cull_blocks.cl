// Kernel 0: which blocks of a picture can see anything at all; the rays of the others are never made. And which nodes of
// the hierarchy each of them meets, from front to back: found once for 64 rays, which are put to little else.
#include "blocks.h"

static BlockNode entry_of(beam b, __global const BvhNode* nodes, u32 node) {
    BlockNode e;
    e.node = node;
    e.entry = beam_entry(b, nodes[node]);
    return e;
}

// From the root down, level by level, as long as there is room: a node gives way to those of its two children that the
// beam meets. The entries are the hierarchy's parameter yet.
static u32 list_nodes(beam b, __global const BvhNode* nodes, __global BlockNode* list) {
    u32 count, k, split = 1;
    list[0] = entry_of(b, nodes, 0);
    count = list[0].entry < BOX_MISSED;
    while (split) {
        const u32 end = count;
        u32 kept = 0;
        split = 0;
        for (k = 0; k < end; ++k) {
            const BlockNode e = list[k];
            BlockNode first, second;
            if (nodes[e.node].leaf || count == LISTED_NODES - 1) {
                list[kept++] = e;
                continue;
            }
            first = entry_of(b, nodes, e.node + 1);
            second = entry_of(b, nodes, nodes[e.node + 1].skip);
            split = 1;
            if (first.entry < BOX_MISSED) list[kept++] = first;
            if (second.entry < BOX_MISSED) {
                if (first.entry < BOX_MISSED) {
                    list[count++] = second;
                } else {
                    list[kept++] = second;
                }
            }
        }
        for (k = end; k < count; ++k) list[kept++] = list[k];
        count = kept;
    }
    return count;
}

static void sort_nodes(beam b, __global BlockNode* list, u32 count) {
    u32 i, k;
    for (i = 0; i < count; ++i) {
        BlockNode e = list[i];
        e.entry = entry_from_center(b, e.entry);
        for (k = i; k > 0; --k) {
            const BlockNode before = list[k - 1];
            if (before.entry <= e.entry) break;
            list[k] = before;
        }
        list[k] = e;
    }
    list[count].node = NONE;
    list[count].entry = BOX_MISSED;
}

// The first leaf is enough.
static u32 meets_anything(beam b, __global const BvhNode* nodes, u32 count) {
    u32 i = 0;
    while (i < count) {
        const BvhNode node = nodes[i];
        const int hit = beam_entry(b, node) < BOX_MISSED;
        if (hit && node.leaf) return 1;
        i = hit ? i + 1 : node.skip;
    }
    return 0;
}

// A work-item is a block: 1 if one of its rays may meet a solid. `lists`: LISTED_NODES a block; 0: they are not wanted.
__kernel void cull_blocks(__global const Frame* frame, __global const BvhNode* nodes, __global unsigned char* blocks,
                          __global BlockNode* lists) {
    u32 id = (u32)get_global_id(0), count = 0;
    beam b;
    if (id >= frame->ray_count / (BLOCK * BLOCK)) return;
    b = make_beam(frame, frame->first_ray / (BLOCK * BLOCK) + id);
    if (lists) {
        lists += (size_t)id * LISTED_NODES;
        if (b.slabs.hits_sphere && frame->node_count > 0) count = list_nodes(b, nodes, lists);
        sort_nodes(b, lists, count);
    } else if (b.slabs.hits_sphere) {
        count = meets_anything(b, nodes, frame->node_count);
    }
    blocks[id] = count > 0 || frame->unbounded_count > 0;
}
