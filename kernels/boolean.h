// Which of a region's leaves a partition lies in, and the walk through the region's linearized tree from one such leaf to
// the next. Every other leaf is outside, and a subtree with all its leaves outside is empty (the compiler refuses regions
// that contain empty space and leaves no complements), so it is never entered: a walk takes as long as the way to a few
// leaves, however large the tree. A right subtree whose value cannot matter is skipped, too. No recursion: a stack entry is
// an operator whose left operand is being looked at; `negate` turns the value around that the current subtree hands up.
// How the compiler keeps the stack short stands in shared/layout.h.
#ifndef CSGRT_BOOLEAN_H
#define CSGRT_BOOLEAN_H

#include "shared/layout.h"

// A ray's segments, and the bits that say which of them cover the partition. Ends are sorted by solid.
typedef struct {
    GLOBAL const End* ends;
    GLOBAL const u32* bits;
    u32 segments;
    GLOBAL const SolidRecord* solids;
    GLOBAL const LeafRecord* leaves;
} cover;

FN u32 covers(cover c, u32 segment) { return c.bits[segment >> 5] >> (segment & 31u) & 1u; }

// The next few covered leaves of all trees, ascending: a window that moves from the first tree to the last. Most partitions
// have no more than fit.
#define LEAVES_KEPT 8
typedef struct {
    LeafRecord kept[LEAVES_KEPT];
    u32 count, at;
    u32 more;  // there may be leaves after those kept
} leaf_window;

// Keeps the first leaves at or after `from`.
FN void fill_window(leaf_window* w, cover c, u32 from) {
    u32 word, words = words_of(c.segments);
    w->count = w->at = w->more = 0;
    for (word = 0; word < words; ++word) {
        u32 bits = c.bits[word];
        while (bits) {
            u32 low = bits & (0u - bits);
            SolidRecord solid = c.solids[c.ends[2 * (32 * word + 31u - clz(low))].solid];
            u32 i;
            bits ^= low;
            for (i = 0; i < solid.leaf_count; ++i) {
                LeafRecord leaf = c.leaves[solid.first_leaf + i];
                u32 k = w->count;
                if (leaf.node < from) continue;
                if (k == LEAVES_KEPT) {
                    w->more = 1;
                    if (leaf.node >= w->kept[k - 1].node) break;  // a solid's leaves ascend
                    --k;
                } else {
                    ++w->count;
                }
                while (k > 0 && w->kept[k - 1].node > leaf.node) {
                    w->kept[k] = w->kept[k - 1];
                    --k;
                }
                w->kept[k] = leaf;
            }
        }
    }
}

// Moves to the first covered leaf at or after `from`, which never goes back. 0: there is none.
FN u32 find_leaf(leaf_window* w, cover c, u32 from) {
    while (w->at < w->count && w->kept[w->at].node < from) ++w->at;
    if (w->at == w->count && w->more) fill_window(w, c, from);
    return w->at < w->count;
}

#define NEGATE_BIT 0x80000000u

// The value of the tree in the words from `node` to `end`.
FN u32 evaluate_tree(GLOBAL const u32* trees, u32 node, u32 end, leaf_window* w, cover c) {
    u32 stack[CSGRT_TREE_STACK], ends[CSGRT_TREE_STACK];
    u32 depth = 0, negate = 0, value;
    for (;;) {
        u32 word, op;
        if (!find_leaf(w, c, node) || w->kept[w->at].node >= end) {
            value = negate;
        } else {
            word = trees[node];
            op = word >> TREE_SHIFT;
            if (op == OP_LEAF) {
                value = 1u ^ negate;
            } else {
                u32 right = word & TREE_MASK;
                if (w->kept[w->at].node < right) {
                    stack[depth] = node | (negate ? NEGATE_BIT : 0u);
                    ends[depth++] = end;
                    negate = 0;
                    ++node;
                    end = right;
                    continue;
                }
                // The left operand is empty.
                if (op != OP_INTERSECTION && op != OP_DIFFERENCE) {
                    node = right;
                    continue;
                }
                value = negate;
            }
        }
        for (;;) {
            u32 entry, outer;
            if (depth == 0) return value;
            entry = stack[--depth];
            outer = entry & NEGATE_BIT ? 1u : 0u;
            word = trees[entry & ~NEGATE_BIT];
            op = word >> TREE_SHIFT;
            if (op == OP_UNION && value) {
                value = 1u ^ outer;
            } else if ((op == OP_INTERSECTION || op == OP_DIFFERENCE) && !value) {
                value = outer;
            } else if (op == OP_REVERSE_DIFFERENCE && value) {
                value = outer;
            } else {
                node = word & TREE_MASK;
                end = ends[depth];
                negate = op == OP_DIFFERENCE ? outer ^ 1u : op == OP_XOR ? outer ^ value : outer;
                break;
            }
        }
    }
}

// The next region, ascending, that claims the partition, from the tree at `*from` on, which is moved behind it; NONE: no
// more. Start with a filled window.
FN u32 next_claim(GLOBAL const RegionRecord* regions, GLOBAL const u32* trees, leaf_window* w, cover c, u32* from) {
    while (find_leaf(w, c, *from)) {
        u32 region = w->kept[w->at].region;
        RegionRecord record = regions[region];
        u32 end = record.first_word + record.word_count;
        *from = end;
        if ((record.flags & REGION_UNION_ONLY) || evaluate_tree(trees, record.first_word, end, w, c)) return region;
    }
    return NONE;
}

#endif
