// Between kernels 1 and 2: exclusive prefix sums over RayCount, in place. A group of SCAN_GROUP items sums SCAN_BLOCK
// entries; the blocks' sums are scanned the same way, one level up, and added. Sums saturate at COUNT_MAX, which tells
// the host that the tile is too large.
#include "shared/layout.h"

#define SCAN_GROUP 64
#define SCAN_EACH 16
#define SCAN_BLOCK (SCAN_GROUP * SCAN_EACH)

static RayCount plus(RayCount a, RayCount b) {
    a.segments = add_sat(a.segments, b.segments);
    a.words = add_sat(a.words, b.words);
    return a;
}

__kernel void scan_blocks(__global RayCount* counts, __global RayCount* sums, u32 size) {
    __local RayCount entries[SCAN_BLOCK];  // neighbours in memory are read by neighbours
    __local RayCount partial[SCAN_GROUP];
    u32 item = (u32)get_local_id(0), block = (u32)get_group_id(0);
    u32 base = block * SCAN_BLOCK, first = item * SCAN_EACH;
    RayCount sum;
    u32 i;
    sum.segments = sum.words = 0;
    for (i = item; i < SCAN_BLOCK; i += SCAN_GROUP) entries[i] = base + i < size ? counts[base + i] : sum;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (i = first; i < first + SCAN_EACH; ++i) sum = plus(sum, entries[i]);
    partial[item] = sum;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (i = 1; i < SCAN_GROUP; i <<= 1) {
        RayCount before;
        before.segments = before.words = 0;
        if (item >= i) before = partial[item - i];
        barrier(CLK_LOCAL_MEM_FENCE);
        partial[item] = plus(partial[item], before);
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    if (item == SCAN_GROUP - 1) sums[block] = partial[item];
    sum.segments = sum.words = 0;
    if (item > 0) sum = partial[item - 1];
    for (i = first; i < first + SCAN_EACH; ++i) {
        RayCount own = entries[i];
        entries[i] = sum;
        sum = plus(sum, own);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (i = item; i < SCAN_BLOCK && base + i < size; i += SCAN_GROUP) counts[base + i] = entries[i];
}

__kernel void scan_add(__global RayCount* counts, __global const RayCount* sums, u32 size) {
    u32 id = (u32)get_global_id(0);
    if (id < size) counts[id] = plus(counts[id], sums[id / SCAN_BLOCK]);
}
