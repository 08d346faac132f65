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
    ENDS const End* ends;
    ENDS const u32* bits;
    u32 segments;
    GLOBAL const SolidRecord* solids;
    GLOBAL const StartRecord* starts;
    GLOBAL const u32* leaves;
} cover;

FN u32 covers(cover c, u32 segment) { return c.bits[segment >> 5] >> (segment & 31u) & 1u; }

// The next few places in the trees, ascending: a window that moves on as they are used up. Most partitions have no more
// than fit.
#define WINDOW 8
typedef struct {
    u32 nodes[WINDOW], regions[WINDOW];
    u32 count, at;
    u32 more;  // there may be some after those kept
} window;

// Takes up a place that is not before the window; 0: it and all greater ones lie behind it.
FN u32 keep(window* w, u32 node, u32 region) {
    u32 k = w->count;
    if (k == WINDOW) {
        w->more = 1;
        if (node >= w->nodes[k - 1]) return 0;
        --k;
    } else {
        ++w->count;
    }
    for (; k > 0 && w->nodes[k - 1] > node; --k) {
        w->nodes[k] = w->nodes[k - 1];
        w->regions[k] = w->regions[k - 1];
    }
    w->nodes[k] = node;
    w->regions[k] = region;
    return 1;
}

// Keeps the first places within [from, end) where covered solids start regions (see StartRecord), or, `leaves`, where they
// stand in trees at all.
FN void fill_window(window* w, cover c, u32 leaves, u32 from, u32 end) {
    u32 word, words = words_of(c.segments);
    w->count = w->at = w->more = 0;
    for (word = 0; word < words; ++word) {
        u32 bits = c.bits[word];
        while (bits) {
            u32 lowest = bits & (0u - bits);
            SolidRecord solid = c.solids[c.ends[2 * (32 * word + 31u - clz(lowest))].solid];
            u32 low = leaves ? solid.first_leaf : solid.first_start;
            u32 high = low + (leaves ? solid.leaf_count : solid.start_count), last = high;
            bits ^= lowest;
            while (low < high) {  // to the first at or after `from`
                u32 middle = (low + high) >> 1;
                if ((leaves ? c.leaves[middle] : c.starts[middle].node) < from) {
                    low = middle + 1;
                } else {
                    high = middle;
                }
            }
            for (; low < last; ++low) {
                u32 node = leaves ? c.leaves[low] : c.starts[low].node;
                if (node >= end || !keep(w, node, leaves ? 0 : c.starts[low].region)) break;
            }
        }
    }
}

// Moves to the first place at or after `from`, which never goes back. 0: there is none before `end`.
FN u32 find_place(window* w, cover c, u32 leaves, u32 from, u32 end) {
    while (w->at < w->count && w->nodes[w->at] < from) ++w->at;
    if (w->at == w->count && w->more) fill_window(w, c, leaves, from, end);
    return w->at < w->count;
}

// The solids that cover a partition, if they are few, with a filter that most others do not pass.
#define FEW 32u
typedef struct {
    u32 count;  // more than FEW: they are not listed
    u32 even, odd;
    u32 solids[FEW];
} few_solids;

FN few_solids list_covered(cover c) {
    few_solids few;
    u32 word, words = words_of(c.segments);
    few.count = few.even = few.odd = 0;
    for (word = 0; word < words; ++word) {
        u32 bits = c.bits[word];
        while (bits) {
            u32 lowest = bits & (0u - bits);
            u32 solid = c.ends[2 * (32 * word + 31u - clz(lowest))].solid;
            u32 bit = 1u << (solid >> 1 & 31u);
            bits ^= lowest;
            if (few.count == FEW) {
                few.count = FEW + 1u;
                return few;
            }
            if (solid & 1u) {
                few.odd |= bit;
            } else {
                few.even |= bit;
            }
            few.solids[few.count++] = solid;
        }
    }
    return few;
}

FN u32 is_covered(const few_solids* few, u32 solid) {
    u32 i;
    if (!((solid & 1u ? few->odd : few->even) >> (solid >> 1 & 31u) & 1u)) return 0;
    for (i = 0; i < few->count; ++i)
        if (few->solids[i] == solid) return 1;
    return 0;
}

// Bit 4 op + left + 2 right: the operator's value.
#define TRUTHS                                                                                                     \
    (0xeu << 4 * OP_UNION | 0x8u << 4 * OP_INTERSECTION | 0x2u << 4 * OP_DIFFERENCE | 0x6u << 4 * OP_XOR | \
     0x4u << 4 * OP_REVERSE_DIFFERENCE)

// The same, word by word from the last: operands come before their operators, and one bit each is kept of them. No step
// waits for another's memory; where trees are not large that is faster than to skip what is empty.
FN u32 scan_tree(GLOBAL const u32* trees, u32 node, u32 end, const few_solids* few) {
    u32 values = 0;
    while (end > node) {
        u32 word = trees[--end], op = word >> TREE_SHIFT;
        if (op == OP_LEAF) {
            values = values << 1 | is_covered(few, word & TREE_MASK);
        } else if (op == OP_NOT) {
            values ^= 1u;
        } else {
            values = (values >> 1 & ~1u) | (TRUTHS >> (4 * op + (values & 3u)) & 1u);
        }
    }
    return values & 1u;
}

#define NEGATE_BIT 0x80000000u

// The value of the tree in the words from `node` to `end`, from covered leaf to covered leaf.
FN u32 walk_tree(GLOBAL const u32* trees, u32 node, u32 end, cover c) {
    u32 stack[CSGRT_TREE_STACK], ends[CSGRT_TREE_STACK];
    u32 depth = 0, negate = 0, value, tree_end = end;
    window w;
    fill_window(&w, c, 1, node, end);
    for (;;) {
        u32 word, op;
        if (!find_place(&w, c, 1, node, tree_end) || w.nodes[w.at] >= end) {
            value = negate;
        } else {
            word = trees[node];
            op = word >> TREE_SHIFT;
            if (op == OP_LEAF) {
                value = 1u ^ negate;
            } else {
                u32 right = word & TREE_MASK;
                if (w.nodes[w.at] < right) {
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

#define NO_END 0xffffffffu
#ifndef SCANNED_WORDS
#define SCANNED_WORDS 256u  // of a tree, that are scanned rather than walked
#endif

FN u32 evaluate_tree(GLOBAL const u32* trees, u32 node, u32 end, cover c, const few_solids* few) {
    if (end - node <= SCANNED_WORDS && few->count <= FEW) return scan_tree(trees, node, end, few);
    return walk_tree(trees, node, end, c);
}

// The next region, ascending, that claims the partition, from the tree at `*from` on, which is moved behind it; NONE: no
// more. `starts`: filled from the first.
FN u32 next_claim(GLOBAL const RegionRecord* regions, GLOBAL const u32* trees, window* starts, cover c,
                  const few_solids* few, u32* from) {
    while (find_place(starts, c, 0, *from, NO_END)) {
        u32 region = starts->regions[starts->at];
        RegionRecord record = regions[region];
        *from = record.first_word + record.word_count;
        if ((record.flags & REGION_UNION_ONLY) || evaluate_tree(trees, record.first_word, *from, c, few)) return region;
    }
    return NONE;
}

#endif
