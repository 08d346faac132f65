// Status tree: the regions that claim the current partition of a deep ray, kept up to date from event to event.
//
// A region's tree may be as deep as it is large, so a change of one leaf must not climb all of it. As in top trees
// (Alstrup et al. 2005), the tree is cut into paths that go down to the larger operand. An operator on a path, together
// with its other operand, turns the value of the path below into its own value. This is one of the four functions of a
// bit, stored in two bits. The composition of such functions is again one of the four, so a path is a balanced tree of
// compositions, whose root gives the path's value. This value sets the function of the operator that the path hangs on.
// The trees are balanced by weight, so the number of steps from a leaf to the region is a few times log2 of the number
// of leaves (src/compile/regions/status_tree.hpp).
//
//   A - (B - (C + D))      path  -, -, +, D      functions  A - x,  B - x,  C + x,  D
//
//           o            a composition: upper(lower(x))
//         /   \              bits f(0), f(1)
//       o       o
//     A-x B-x C+x  D
#ifndef CSGRT_BOOLEAN_STATUS_TREE_H
#define CSGRT_BOOLEAN_STATUS_TREE_H

#include "../shared/layout.h"

// Functions of one bit: f(0) is bit 0, f(1) is bit 1.
FN u32 composed(u32 upper, u32 lower) { return (upper >> (lower & 1u) & 1u) | (upper >> (lower >> 1) & 1u) << 1; }

// The function that an operator becomes where its other operand is false (low bits), and where it is true.
#define RAKE_TABLE                                                                                            \
    (0xeu << 4 * RAKE_UNION | 0x8u << 4 * RAKE_COMMON | 0x4u << 4 * RAKE_MINUEND | 0x2u << 4 * RAKE_REMOVED | \
     0x6u << 4 * RAKE_XOR)
// The function of an operator whose other operand is a path. `f`: the whole path's function, which is constant.
FN u32 raked(u32 rake, u32 f) { return rake == RAKE_NONE ? f : RAKE_TABLE >> (4 * rake + 2 * (f & 1u)) & 3u; }

// The function of a cluster. `status` has 16 functions a word.
FN u32 function_of(GLOBAL const u32* status, u32 cluster) { return status[cluster >> 4] >> 2 * (cluster & 15u) & 3u; }

// Changes the function of a leaf's cluster by the bits that are set in `change`, and the functions of all clusters
// above it. Returns the region whose value changes, or NONE.
FN u32 change_leaf(GLOBAL u32* status, GLOBAL const u32* links, u32 cluster, u32 change) {
    u32 region = NONE;
    do {
        const u32 link = links[cluster >> 1];
        status[cluster >> 4] ^= change << 2 * (cluster & 15u);
        if (link >> TREE_SHIFT == REGION_LINK) {
            region = link & TREE_MASK;
            change = 0;
        } else {
            const u32 f = composed(function_of(status, cluster & ~1u), function_of(status, cluster | 1u));
            cluster = link & TREE_MASK;
            change = function_of(status, cluster) ^ raked(link >> TREE_SHIFT, f);
        }
    } while (change);
    return region;
}

// ---- A set of regions, from which the least is taken ---- A region has a bit. If the set is larger than a word, a
// second level has a bit for each word that is not 0. Levels follow until a level is one word.
FN u32 words_of_set(u32 regions) {
    u32 words = 0;
    do {
        regions = (regions + 31u) >> 5;
        words += regions;
    } while (regions > 1);
    return words;
}

// Adds the region to the set, or removes it.
FN void toggle(GLOBAL u32* set, u32 regions, u32 region) {
    u32 words = regions, goes_on;
    do {
        const u32 before = set[region >> 5], after = before ^ 1u << (region & 31u);
        set[region >> 5] = after;
        words = (words + 31u) >> 5;
        goes_on = words > 1 && (!before || !after);
        set += words;
        region >>= 5;
    } while (goes_on);
}

// The least member at or after `from`; NONE: there is none.
FN u32 member_from(GLOBAL const u32* set, u32 regions, u32 from) {
    u32 words = (regions + 31u) >> 5, level = 0, bits = 0;
    if (from >> 5 < words) bits = set[from >> 5] & 0xffffffffu << (from & 31u);
    while (!bits && words > 1) {
        from = (from >> 5) + 1;
        set += words;
        words = (words + 31u) >> 5;
        ++level;
        if (from >> 5 < words) bits = set[from >> 5] & 0xffffffffu << (from & 31u);
    }
    if (!bits) return NONE;
    from = (from & ~31u) | lowest(bits);
    for (; level > 0; --level) {
        set -= ((regions - 1u) >> 5 * level) + 1u;
        from = from << 5 | lowest(set[from]);
    }
    return from;
}

#endif
