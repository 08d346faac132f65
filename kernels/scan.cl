// Scan, between kernels 1 and 2: exclusive prefix sums over RayCount, in place. A group of SCAN_GROUP work-items sums
// SCAN_BLOCK entries; one group sums the blocks' sums, which are added to their entries. Sums saturate at COUNT_MAX,
// which tells the host that the batch is too large.
//
//   scan blocks -> scan sums -> scan add
#include "shared/layout.h"

#define SCAN_GROUP 64
#define SCAN_EACH 16
#define SCAN_BLOCK (SCAN_GROUP * SCAN_EACH)

// The index of a block's entry in local memory. The gaps keep work-items, each of which goes through SCAN_EACH entries,
// from using the same bank of memory.
#define SCAN_PLACE(i) ((i) + (i) / SCAN_EACH)
#define SCAN_PLACES SCAN_PLACE(SCAN_BLOCK)

static RayCount plus(RayCount a, RayCount b) {
    a.segments = add_sat(a.segments, b.segments);
    a.words = add_sat(a.words, b.words);
    return a;
}

// Replaces each of a block's `size` entries by the sum of `before` and the entries before it. One group runs the
// function. Returns the sum of `before` and all entries.
static RayCount scan_block(__global RayCount* counts, u32 size, RayCount before, __local RayCount* entries,
                           __local RayCount* partial) {
    const u32 item = (u32)get_local_id(0), first = item * SCAN_EACH;
    RayCount sum;
    u32 i;
    sum.segments = sum.words = 0;
    for (i = item; i < SCAN_BLOCK; i += SCAN_GROUP)  // neighbours in memory are read by neighbouring work-items
        entries[SCAN_PLACE(i)] = i < size ? counts[i] : sum;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (i = first; i < first + SCAN_EACH; ++i) sum = plus(sum, entries[SCAN_PLACE(i)]);
    partial[item] = sum;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (i = 1; i < SCAN_GROUP; i <<= 1) {
        RayCount left;
        left.segments = left.words = 0;
        if (item >= i) left = partial[item - i];
        barrier(CLK_LOCAL_MEM_FENCE);
        partial[item] = plus(partial[item], left);
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    sum = item > 0 ? plus(before, partial[item - 1]) : before;
    for (i = first; i < first + SCAN_EACH; ++i) {
        const RayCount own = entries[SCAN_PLACE(i)];
        entries[SCAN_PLACE(i)] = sum;
        sum = plus(sum, own);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (i = item; i < SCAN_BLOCK && i < size; i += SCAN_GROUP) counts[i] = entries[SCAN_PLACE(i)];
    sum = plus(before, partial[SCAN_GROUP - 1]);
    barrier(CLK_LOCAL_MEM_FENCE);  // the next block uses the same memory
    return sum;
}

__kernel void scan_blocks(__global RayCount* counts, __global RayCount* sums, u32 size) {
    __local RayCount entries[SCAN_PLACES], partial[SCAN_GROUP];
    const u32 block = (u32)get_group_id(0), base = block * SCAN_BLOCK;
    RayCount sum;
    sum.segments = sum.words = 0;
    sum = scan_block(counts + base, size - base, sum, entries, partial);
    if (get_local_id(0) == 0) sums[block] = sum;
}

// Sums the blocks' sums. One group runs the kernel.
__kernel void scan_sums(__global RayCount* sums, u32 size) {
    __local RayCount entries[SCAN_PLACES], partial[SCAN_GROUP];
    RayCount sum;
    u32 base;
    sum.segments = sum.words = 0;
    for (base = 0; base < size; base += SCAN_BLOCK) sum = scan_block(sums + base, size - base, sum, entries, partial);
}

__kernel void scan_add(__global RayCount* counts, __global const RayCount* sums, u32 size) {
    u32 id = (u32)get_global_id(0);
    if (id < size) counts[id] = plus(counts[id], sums[id / SCAN_BLOCK]);
}
