// Kernel 4: which region claims each partition. Front to back; unless every partition is wanted, the first claimed one
// ends the work for its ray: nothing behind it is seen.
//
// Overlap: the smallest index keeps the partition, as in BRL-CAD. A rule that looked at the partition before would depend on
// the direction of the ray.
#include "boolean.h"
#include "camera.h"

__kernel void evaluate(__global const Frame* frame, __global const SolidRecord* solids,
                       __global const StartRecord* starts, __global const u32* leaves,
                       __global const u32* trees, __global const RayCount* offsets, __global const End* all_ends,
                       __global PartitionNode* all_nodes, __global const u32* all_bits, __global RayResult* results,
                       __global const RayRecord* rays) {
    u32 id = (u32)get_global_id(0);
    RayResult result;
    RayCount offset;
    u32 node, words;
    real t_min;
    cover c;
    __global PartitionNode* list;
    if (id >= frame->ray_count) return;
    result = results[id];
    if (result.first == NONE) return;
    offset = offsets[id];
    c.segments = offsets[id + 1].segments - offset.segments;
    c.ends = all_ends + 2 * (size_t)offset.segments;
    c.solids = solids;
    c.starts = starts;
    c.leaves = leaves;
    c.trees = trees;
    list = all_nodes + 2 * (size_t)offset.segments;
    words = words_of(c.segments);
    node = result.first;
    t_min = t_min_of(frame, number_of(frame, rays, id));
    result.first = NONE;
    while (node != NONE) {
        PartitionNode partition = list[node];
        covered_solids covered;
        claim found;
        u32 overlap;
        c.bits = all_bits + offset.words + node * words;
        covered = list_covered(c);
        found = find_claim(c, &covered, 1, all_solids());
        overlap = found.other != NONE;
        result.overlaps += overlap;
        list[node].region = found.least | (overlap ? OVERLAP : 0u);
        if (found.least != NONE && result.first == NONE && c.ends[partition.out_end].t > t_min) {
            result.first = node;
            if (!frame->every_partition) break;
        }
        node = partition.next;
    }
    results[id] = result;
}
