// Kernel 4: which region claims each partition. A work-item is a node, so that no partition waits for those before it.
//
// Overlap: the smallest index keeps the partition, as in BRL-CAD. A rule that looked at the partition before would depend on
// the direction of the ray.
#include "boolean.h"

__kernel void evaluate(__global const SolidRecord* solids, __global const StartRecord* starts, __global const u32* leaves,
                       __global const u32* trees, __global const RayCount* offsets, __global const End* all_ends,
                       __global const u32* all_bits, u32 size, __global PartitionNode* nodes) {
    u32 id = (u32)get_global_id(0);
    PartitionNode node;
    RayCount offset;
    cover c;
    covered_solids covered;
    u32 owner = ALONE_UNKNOWN;
    if (id >= size) return;
    node = nodes[id];
    if (node.in_end == NONE) return;
    offset = offsets[node.owner];
    c.segments = offsets[node.owner + 1].segments - offset.segments;
    c.ends = all_ends + 2 * (size_t)offset.segments;
    c.bits = all_bits + offset.words + (id - 2 * offset.segments) * words_of(c.segments);
    c.solids = solids;
    c.starts = starts;
    c.leaves = leaves;
    c.trees = trees;
    list_covered(c, &covered);
    if (covered.count == 1) owner = solids[covered.solids[0]].alone;
    if (owner == ALONE_UNKNOWN) {
        const claim found = find_claim(c, &covered, 1, all_solids());
        owner = found.least | (found.other != NONE ? OVERLAP : 0u);
    }
    nodes[id].owner = owner;
}
