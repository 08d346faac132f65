// After the kernels of a tile, on a GPU to which the host's picture is known: from the pixels of the drawn blocks to lines that
// can be copied into it.
#include "camera.h"

// Which of the tile's drawn blocks show something: a block that a solid's box is before may show nothing, and in pictures of
// some models half of them do. A group of BLOCK * BLOCK items a block.
// numbers: of the drawn blocks. picture: for each plane the floats of their rays. places: where each of the tile's blocks from
// number `first` on stands among the drawn ones, if it shows something; NONE before. extents: two for each of the tile's rows of
// blocks, zeros before: how many blocks it is from the left edge to behind the last that shows something, and from the right
// edge to before the first.
__kernel void find_shown(u32 width, u32 height, u32 planes, PlaneValues background, u32 first, __global const u32* numbers,
                         __global const float* picture, __global u32* places, __global u32* extents) {
    __local u32 shows;
    const u32 block = (u32)get_group_id(0), ray = (u32)get_local_id(0), number = numbers[block];
    const size_t plane = get_global_size(0);
    if (ray == 0) shows = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (pixel_of(number * (BLOCK * BLOCK) + ray, width, height).inside) {
        u32 p, differs = 0;
        picture += (size_t)block * (BLOCK * BLOCK) + ray;
        for (p = 0; p < planes; ++p) differs |= as_uint(picture[p * plane]) ^ as_uint(background.of[p]);
        if (differs) atomic_or(&shows, 1u);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (ray == 0 && shows) {
        const u32 across = (width + BLOCK - 1u) / BLOCK, row = number / across - first / across, column = number % across;
        places[number - first] = block;
        atomic_max(extents + 2 * row, column + 1u);
        atomic_max(extents + 2 * row + 1, across - column);
    }
}

// The pixels of a rectangle, plane by plane, line by line, into `lines` from float `begin` on; background where none of the tile's
// `count` blocks shows something. rays: of a plane of `picture`.
__kernel void put_lines(u32 width, u32 planes, PlaneValues background, u32 first, u32 count, u32 rays, u32 left, u32 top,
                        u32 columns, u32 rows, u32 begin, __global const u32* places, __global const float* picture,
                        __global float* lines) {
    const u32 id = (u32)get_global_id(0), x = left + id % columns, y = top + id / columns;
    const u32 block = y / BLOCK * ((width + BLOCK - 1u) / BLOCK) + x / BLOCK - first;  // wraps around before the first
    const size_t plane = (size_t)columns * rows;
    u32 place, p;
    if (id >= plane) return;
    place = block < count ? places[block] : NONE;
    lines += begin + id;
    if (place == NONE) {
        for (p = 0; p < planes; ++p) lines[p * plane] = background.of[p];
    } else {
        picture += (size_t)place * (BLOCK * BLOCK) + y % BLOCK * BLOCK + x % BLOCK;
        for (p = 0; p < planes; ++p) lines[p * plane] = picture[(size_t)p * rays];
    }
}
