// The walk through a region's linearized tree for one partition: no recursion, and a right subtree whose value cannot
// matter is skipped. A stack entry is a node whose left child is being looked at; `negate` turns the value around that
// the current subtree hands up to it. How the compiler keeps the stack short stands in shared/layout.h.
#ifndef CSGRT_BOOLEAN_H
#define CSGRT_BOOLEAN_H

#include "shared/layout.h"

// A ray's segments, and the bits that say which of them cover the partition. Ends are sorted by solid.
typedef struct {
    GLOBAL const End* ends;
    GLOBAL const u32* bits;
    u32 segments;
} cover;

FN u32 covers(cover c, u32 segment) { return c.bits[segment >> 5] >> (segment & 31u) & 1u; }

// Is one of the solid's segments among those that cover the partition?
FN u32 covered_by(cover c, u32 solid) {
    u32 low = 0, high = c.segments;
    while (low < high) {
        u32 middle = (low + high) >> 1;
        if (c.ends[2 * middle].solid < solid) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    for (; low < c.segments && c.ends[2 * low].solid == solid; ++low)
        if (covers(c, low)) return 1;
    return 0;
}

#define NEGATE_BIT 0x80000000u

FN u32 evaluate_tree(GLOBAL const u32* trees, u32 first, cover c) {
    u32 stack[CSGRT_TREE_STACK];
    u32 depth = 0, node = first, negate = 0, value;
    for (;;) {
        u32 word = trees[node];
        u32 op = word >> TREE_SHIFT;
        if (op == OP_NOT) {
            negate ^= 1u;
            ++node;
            continue;
        }
        if (op != OP_LEAF) {
            stack[depth++] = node | (negate ? NEGATE_BIT : 0u);
            negate = 0;
            ++node;
            continue;
        }
        value = covered_by(c, word & TREE_MASK) ^ negate;
        for (;;) {
            u32 entry, right, outer;
            if (depth == 0) return value;
            entry = stack[--depth];
            outer = entry & NEGATE_BIT ? 1u : 0u;
            word = trees[entry & ~NEGATE_BIT];
            op = word >> TREE_SHIFT;
            right = word & TREE_MASK;
            if (op == OP_UNION && value) {
                value = 1u ^ outer;
            } else if ((op == OP_INTERSECTION || op == OP_DIFFERENCE) && !value) {
                value = outer;
            } else if (op == OP_REVERSE_DIFFERENCE && value) {
                value = outer;
            } else {
                node = right;
                negate = op == OP_DIFFERENCE ? outer ^ 1u : op == OP_XOR ? outer ^ value : outer;
                break;
            }
        }
    }
}

#endif
