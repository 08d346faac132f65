// Kernel 4: which region claims each partition. Front to back; unless every partition is wanted, the first claimed one
// ends the work for its ray: nothing behind it is seen.
//
// The region table of a partition holds the regions whose trees contain one of its solids; only they can claim it (a
// region that contains empty space is refused when it is compiled). Here it is a bit array over the ray's own
// candidates, 32 at a time, ascending: so the first claim is the smallest index.
// Overlap: the smallest index keeps the partition, as in BRL-CAD. A rule that looked at the partition before would depend on
// the direction of the ray.
#include "boolean.h"
#include "camera.h"

// The distinct regions of the ray's solids, ascending.
static u32 collect_candidates(__global const SolidRecord* solids, __global const u32* region_lists,
                              __global const End* ends, u32 segments, __global u32* candidates) {
    u32 count = 0, s, i;
    for (s = 0; s < segments; ++s) {
        u32 solid = ends[2 * s].solid;
        u32 first, end;
        if (s > 0 && ends[2 * s - 2].solid == solid) continue;
        first = solids[solid].first_region;
        end = first + solids[solid].region_count;
        for (i = first; i < end; ++i) {
            u32 region = region_lists[i];
            u32 at = count;
            while (at > 0 && candidates[at - 1] > region) --at;
            if (at > 0 && candidates[at - 1] == region) continue;
            {
                u32 k;
                for (k = count; k > at; --k) candidates[k] = candidates[k - 1];
            }
            candidates[at] = region;
            ++count;
        }
    }
    return count;
}

static u32 position_of(__global const u32* candidates, u32 count, u32 region) {
    u32 low = 0, high = count;
    while (low + 1 < high) {
        u32 middle = (low + high) >> 1;
        if (candidates[middle] <= region) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

// Bits of the candidates [32 * word, 32 * word + 32) that may claim the partition.
static u32 region_table(__global const SolidRecord* solids, __global const u32* region_lists, cover c,
                        __global const u32* candidates, u32 count, u32 word) {
    u32 table = 0, w, i;
    if (count == 1) return 1;
    for (w = 0; w < words_of(c.segments); ++w) {
        u32 bits = c.bits[w];
        while (bits) {
            u32 bit = 31u - clz(bits & -bits);
            u32 solid = c.ends[2 * (32 * w + bit)].solid;
            u32 first = solids[solid].first_region;
            u32 end = first + solids[solid].region_count;
            bits &= bits - 1;
            for (i = first; i < end; ++i) {
                u32 at = position_of(candidates, count, region_lists[i]);
                if (at >> 5 == word) table |= 1u << (at & 31u);
            }
        }
    }
    return table;
}

__kernel void evaluate(__global const Frame* frame, __global const SolidRecord* solids,
                       __global const RegionRecord* regions, __global const u32* region_lists,
                       __global const u32* trees, __global const RayCount* offsets, __global const End* all_ends,
                       __global PartitionNode* all_nodes, __global const u32* all_bits, __global u32* all_candidates,
                       __global RayResult* results) {
    u32 id = (u32)get_global_id(0);
    RayResult result;
    RayCount offset;
    u32 count, node, words;
    real t_min;
    cover c;
    __global PartitionNode* list;
    __global u32* candidates;
    if (id >= frame->ray_count) return;
    result = results[id];
    if (result.first == NONE) return;
    offset = offsets[id];
    c.segments = offsets[id + 1].segments - offset.segments;
    c.ends = all_ends + 2 * (size_t)offset.segments;
    list = all_nodes + 2 * (size_t)offset.segments;
    candidates = all_candidates + offset.regions;
    words = words_of(c.segments);
    count = collect_candidates(solids, region_lists, c.ends, c.segments, candidates);
    node = result.first;
    result.first = NONE;
    t_min = t_min_of(frame, frame->first_ray + id);
    while (node != NONE) {
        PartitionNode partition = list[node];
        u32 claimed = NONE, claims = 0, word;
        c.bits = all_bits + offset.words + node * words;
        for (word = 0; 32 * word < count; ++word) {
            u32 table = region_table(solids, region_lists, c, candidates, count, word);
            while (table) {
                u32 bit = 31u - clz(table & -table);
                u32 region = candidates[32 * word + bit];
                RegionRecord record = regions[region];
                table &= table - 1;
                if ((record.flags & REGION_UNION_ONLY) || evaluate_tree(trees, record.first_word, c)) {
                    if (claimed == NONE) claimed = region;
                    ++claims;
                }
            }
        }
        if (claims > 1) ++result.overlaps;
        list[node].region = claimed | (claims > 1 ? OVERLAP : 0u);
        if (claimed != NONE && result.first == NONE && c.ends[partition.out_end].t > t_min) {
            result.first = node;
            if (!frame->every_partition) break;
        }
        node = partition.next;
    }
    results[id] = result;
}
