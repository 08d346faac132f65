// Before the kernels of a tile whose pixels come by lines, on a GPU: which of its blocks see anything, those that cost most first,
// so that the host need not say, and wait before it does; and the background of all others.
#include "camera.h"

// A class for every half of a power of two.
static u32 class_of(u32 cost) {
    const u32 power = 31u - clz(cost);
    return cost < 2 ? cost : 2 * power + (cost >> (power - 1u) & 1u);
}

// costs: kernel 0's, of `count` blocks. An item a block.
__kernel void count_blocks(__global const unsigned char* costs, u32 count, __global TileTally* tally) {
    __local u32 blocks[COST_CLASSES];
    const u32 id = (u32)get_global_id(0), item = (u32)get_local_id(0);
    if (item < COST_CLASSES) blocks[item] = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (id < count) atomic_inc(blocks + class_of(costs[id]));
    barrier(CLK_LOCAL_MEM_FENCE);
    if (item < COST_CLASSES && blocks[item]) atomic_add(tally->blocks + item, blocks[item]);
}

// The numbers of the tile's blocks, from `first` on, in `numbers`: those of the same class in any order. A device that ends with the
// longest waits for it.
__kernel void list_blocks(__global const unsigned char* costs, u32 first, u32 count, __global TileTally* tally, __global u32* numbers) {
    __local u32 blocks[COST_CLASSES], places[COST_CLASSES];
    const u32 id = (u32)get_global_id(0), item = (u32)get_local_id(0);
    u32 own = COST_CLASSES, before = 0;
    if (item < COST_CLASSES) blocks[item] = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (id < count) {
        own = class_of(costs[id]);
        before = atomic_inc(blocks + own);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (item < COST_CLASSES) {
        u32 place = atomic_add(tally->listed + item, blocks[item]), k;
        for (k = item + 1; k < COST_CLASSES; ++k) place += tally->blocks[k];
        places[item] = place;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (own < COST_CLASSES) numbers[places[own] + before] = first + id;
    if (id == 0) tally->seen = count - tally->blocks[0];
}

// Fills what no ray will, of a picture of whole lines of the window. A group of BLOCK * BLOCK items a block.
__kernel void put_background(__global const unsigned char* costs, Window window, u32 first_ray, u32 lines, u32 planes,
                             PlaneValues background, __global float* picture) {
    pixel_position at;
    u32 p;
    if (costs[get_group_id(0)]) return;
    at = pixel_of(first_ray + (u32)get_global_id(0), window);
    if (!at.inside) return;
    picture += place_in_lines(window, first_ray, at);
    for (p = 0; p < planes; ++p) picture[(size_t)p * lines * width_of(window)] = background.of[p];
}
