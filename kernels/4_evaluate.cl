// Kernel 4: which region claims each partition. Front to back; unless every partition is wanted, the first claimed one
// ends the work for its ray: nothing behind it is seen.
//
// Only regions that one of the partition's solids starts can claim it (see StartRecord). They come in order of their trees, so the first claim is the smallest index.
// Overlap: the smallest index keeps the partition, as in BRL-CAD. A rule that looked at the partition before would depend on
// the direction of the ray.
#include "boolean.h"
#include "camera.h"

__kernel void evaluate(__global const Frame* frame, __global const SolidRecord* solids,
                       __global const RegionRecord* regions, __global const StartRecord* starts, __global const u32* leaves,
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
    list = all_nodes + 2 * (size_t)offset.segments;
    words = words_of(c.segments);
    node = result.first;
    t_min = t_min_of(frame, number_of(frame, rays, id));
    result.first = NONE;
    while (node != NONE) {
        PartitionNode partition = list[node];
        window w;
        few_solids few;
        u32 from = 0, claimed, overlap;
        c.bits = all_bits + offset.words + node * words;
        fill_window(&w, c, 0, 0, NO_END);
        few = list_covered(c);
        claimed = next_claim(regions, trees, &w, c, &few, &from);
        overlap = claimed != NONE && next_claim(regions, trees, &w, c, &few, &from) != NONE;
        result.overlaps += overlap;
        list[node].region = claimed | (overlap ? OVERLAP : 0u);
        if (claimed != NONE && result.first == NONE && c.ends[partition.out_end].t > t_min) {
            result.first = node;
            if (!frame->every_partition) break;
        }
        node = partition.next;
    }
    results[id] = result;
}
