// Tile list: runs on a GPU before the other kernels of a batch whose picture is row-major. It lists the tiles that see
// anything, the most expensive first, so that the host can launch the other kernels without waiting for the list. It
// also writes the background of the other tiles.
#include "traversal/camera.h"

// Classes of cost: one for each cost below 16, then eight for every power of two.
static u32 class_of(u32 cost) {
    const u32 power = 31u - clz(cost | 1u);
    return cost < 16u ? cost : 8u * power - 16u + (cost >> (power - 3u) & 7u);
}

// Counts the tiles of each class, one work-item a tile. `costs`: kernel 0's costs of `count` tiles.
__kernel void count_tiles(__global const unsigned char* costs, u32 count, __global BatchReport* report) {
    __local u32 tiles[COST_CLASSES];
    const u32 id = (u32)get_global_id(0), item = (u32)get_local_id(0);
    if (item < COST_CLASSES) tiles[item] = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (id < count) atomic_inc(tiles + class_of(costs[id]));
    barrier(CLK_LOCAL_MEM_FENCE);
    if (item < COST_CLASSES && tiles[item]) atomic_add(report->tiles + item, tiles[item]);
}

// The number of entries in the list for a tile of the class.
static u32 parts_of(u32 class_number, u32 in_parts) { return in_parts && class_number >= PARTED_CLASS ? PARTS : 1u; }

// Are the most expensive tiles listed in parts? The list has memory for one entry a tile. The parts use the entries of
// tiles that see nothing.
static u32 are_in_parts(__local const u32* tiles, u32 most_in_parts) {
    u32 k, in_parts = 0;
    for (k = PARTED_CLASS; k < COST_CLASSES; ++k) in_parts += tiles[k];
    return in_parts <= most_in_parts && in_parts * (PARTS - 1u) <= tiles[0];
}

// Stores in `numbers` the batch's tiles that see anything. `first`: the number of the batch's first tile. Tiles of one
// class come in any order. The most expensive tiles come first, since otherwise the device waits for them at the end.
// Tiles of the classes from PARTED_CLASS on are listed in parts if there are at most `most_in_parts` of them.
__kernel void list_tiles(__global const unsigned char* costs, u32 first, u32 count, u32 most_in_parts,
                         __global BatchReport* report, __global u32* numbers) {
    __local u32 all[COST_CLASSES], tiles[COST_CLASSES], places[COST_CLASSES];
    const u32 id = (u32)get_global_id(0), item = (u32)get_local_id(0);
    u32 own = 0, before = 0, in_parts, k;
    if (item < COST_CLASSES) {
        all[item] = report->tiles[item];
        tiles[item] = 0;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    in_parts = are_in_parts(all, most_in_parts);
    if (id < count) {
        own = class_of(costs[id]);
        before = atomic_inc(tiles + own);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (item < COST_CLASSES) {
        u32 place = 0;
        for (k = item + 1; k < COST_CLASSES; ++k) place += all[k] * parts_of(k, in_parts);
        if (id == 0) report->entries = place;
        if (tiles[item])
            places[item] = place + atomic_add(report->listed + item, tiles[item]) * parts_of(item, in_parts);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (own > 0) {
        const u32 parts = parts_of(own, in_parts);
        for (k = 0; k < parts; ++k)
            numbers[places[own] + before * parts + k] = (first + id) | (parts > 1u ? parts + k : 0u) << PART_SHIFT;
    }
}

// Writes the background of tiles that see nothing, in a row-major picture. One group of TILE * TILE work-items a tile.
__kernel void write_background(__global const unsigned char* costs, ScreenBounds screen, u32 first_ray, u32 rows,
                               u32 channels, ChannelValues background, __global float* picture) {
    pixel_position at;
    u32 c;
    if (costs[get_group_id(0)]) return;
    at = pixel_of(first_ray + (u32)get_global_id(0), screen);
    if (!at.inside) return;
    picture += row_major_place(screen, first_ray, at);
    for (c = 0; c < channels; ++c) picture[(size_t)c * rows * width_of(screen)] = background.of[c];
}
