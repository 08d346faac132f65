// What kernel 0 leaves behind of a tile whose pixels come by lines, one item or several a block.
#ifndef CSGRT_TALLY_H
#define CSGRT_TALLY_H

#include "blocks.h"

// Nothing is counted yet, and no block shows anything. There are as many items as blocks, or more.
static void clear_tally(__global TileTally* tally, u32 blocks, u32 item) {
    u32 k;
    for (k = item; k < sizeof(TileTally) / sizeof(u32); k += (u32)get_global_size(0)) ((__global u32*)tally)[k] = 0;
    if (item < blocks) ((__global unsigned char*)(tally + 1))[item] = 0;
}

#endif
