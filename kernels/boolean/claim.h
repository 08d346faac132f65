// Claims: finds the regions that claim a partition.
//
// A region's tree is a union of terms (the name is from Goldfeather et al. 1986). A term that is no leaf is an
// intersection, a difference or a xor. A term can only be true where one of the leaves that start it is covered
// (StartRecord). So the kernel evaluates only the terms that some solid of the partition starts, however large the
// region is.
//
//   region   (a + b - c) u (d - e) u f
//   starts    a or b        d        f       cover {c, d}: only d - e is evaluated
#ifndef CSGRT_BOOLEAN_CLAIM_H
#define CSGRT_BOOLEAN_CLAIM_H

#include "../shared/layout.h"

// A ray's segments, and the bits that say which of them cover the partition.
typedef struct {
    BOUNDARY_SPACE const Boundary* boundaries;
    BOUNDARY_SPACE const u32* bits;
    u32 segments;
    u32 missed;  // missed_on() of a side: segments that miss this side do not cover
    u32 marked;  // 0: no segment has MISSED_... set
    u32 beyond;  // MISSED_...: sides that a plane of the view cuts away
    GLOBAL const SolidRecord* solids;
    GLOBAL const StartRecord* starts;
    GLOBAL const u32* trees;
} cover;

FN u32 is_missed(cover c, u32 segment) { return c.missed && (c.boundaries[2 * segment].surface & c.missed); }
FN u32 covers(cover c, u32 segment) { return (c.bits[segment >> 5] >> (segment & 31u) & 1u) && !is_missed(c, segment); }

// The solids that cover a partition: a list if they are few, and a (Bloom) filter that most other solids do not pass.
#ifdef CSGRT_FEW
#define FEW CSGRT_FEW  // a multiple of 32
#else
#define FEW 32u
#endif
typedef struct {
    u32 count;      // more than FEW: the solids are not listed
    u32 even, odd;  // the filter
    u32 missed;     // MISSED_... of all their segments
    u32 solids[FEW];
} covered_solids;

// Reads the filter word by word: a processor that has just stored two words waits longer if it loads both at once.
FN SolidFilter filter_of_covered(const covered_solids* list) {
    SolidFilter f;
    f.even = list->even;
    f.odd = list->odd;
    return f;
}

// Returns the segment of the lowest bit of a word, and clears the bit.
FN u32 take_segment_of(u32 word, u32* bits) {
    u32 lowest = *bits & (0u - *bits);
    *bits ^= lowest;
    return 32 * word + 31u - clz(lowest);
}

FN void list_covered(cover c, covered_solids* list) {
    u32 word, words = words_of(c.segments), count = 0;
    SolidFilter filter;
    filter.even = filter.odd = 0;
    list->missed = 0;
    for (word = 0; word < words; ++word) {
        u32 bits = c.bits[word];
        while (bits) {
            const u32 segment = take_segment_of(word, &bits), solid = c.boundaries[2 * segment].solid;
            if (is_missed(c, segment)) continue;
            if (c.marked) list->missed |= c.boundaries[2 * segment].surface & MISSED;
            filter = with(filter, filter_of(solid));
            if (count < FEW) list->solids[count] = solid;
            if (count <= FEW) ++count;
        }
    }
    list->count = count;
    list->even = filter.even;
    list->odd = filter.odd;
}

FN u32 is_covered(cover c, const covered_solids* list, u32 solid) {
    u32 low = 0, high = c.segments;
    if (!within(filter_of(solid), filter_of_covered(list))) return 0;
    if (list->count <= FEW) {
        while (low < list->count && list->solids[low] != solid) ++low;
        return low < list->count;
    }
    while (low < high) {  // many solids: a ray's boundaries are sorted by solid in memory
        u32 middle = (low + high) >> 1;
        if (c.boundaries[2 * middle].solid < solid) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    for (; low < c.segments && c.boundaries[2 * low].solid == solid; ++low)
        if (covers(c, low)) return 1;
    return 0;
}

// Bit 4 op + left + 2 right: the operator's value.
#define OPERATOR_TABLE                                                                                     \
    (0xeu << 4 * OP_UNION | 0x8u << 4 * OP_INTERSECTION | 0x2u << 4 * OP_DIFFERENCE | 0x6u << 4 * OP_XOR | \
     0x4u << 4 * OP_REVERSE_DIFFERENCE)

// The value of the term in the words from `node` to `end`. The last word comes first, so operands come before their
// operators, and each operand is one bit of `values`. No step waits for the memory of another step.
FN u32 scan_term(cover c, const covered_solids* list, u32 node, u32 end) {
    u32 values = 0;
    while (end > node) {
        u32 word = c.trees[--end], op = word >> TREE_SHIFT;
        if (op == OP_LEAF) {
            values = values << 1 | is_covered(c, list, word & TREE_MASK);
        } else {
            values = (values >> 1 & ~1u) | (OPERATOR_TABLE >> (4 * op + (values & 3u)) & 1u);
        }
    }
    return values & 1u;
}

#ifdef CSGRT_LARGE_TERMS
// The next few covered leaves of a large term, ascending. When they are used up, the cursor finds the next few.
#define CURSOR_LEAVES 8
typedef struct {
    u32 nodes[CURSOR_LEAVES];
    u32 count, at;
    u32 more;  // 1: there may be leaves after the kept leaves
} leaf_cursor;

// Keeps a leaf if it is among the first CURSOR_LEAVES leaves so far; 0: this leaf is not, nor is any greater leaf.
FN u32 keep(leaf_cursor* w, u32 node) {
    u32 k = w->count;
    if (k == CURSOR_LEAVES) {
        w->more = 1;
        if (node >= w->nodes[k - 1]) return 0;
        --k;
    } else {
        ++w->count;
    }
    for (; k > 0 && w->nodes[k - 1] > node; --k) w->nodes[k] = w->nodes[k - 1];
    w->nodes[k] = node;
    return 1;
}

// Keeps the first leaves within [from, end) that are covered.
FN void fill_cursor(leaf_cursor* w, cover c, u32 from, u32 end) {
    u32 word, words = words_of(c.segments);
    w->count = w->at = w->more = 0;
    for (word = 0; word < words; ++word) {
        u32 bits = c.bits[word];
        while (bits) {
            const u32 segment = take_segment_of(word, &bits), solid = c.boundaries[2 * segment].solid;
            u32 low = c.solids[solid].first_leaf, high = low + c.solids[solid].leaf_count, last = high;
            while (low < high) {  // finds the first leaf at or after `from`
                u32 middle = (low + high) >> 1;
                if (c.trees[middle] < from) {
                    low = middle + 1;
                } else {
                    high = middle;
                }
            }
            if (is_missed(c, segment)) continue;
            for (; low < last; ++low) {
                u32 node = c.trees[low];
                if (node >= end || !keep(w, node)) break;
            }
        }
    }
}

// Moves to the first leaf at or after `from`, which never decreases from call to call. 0: there is no leaf before
// `end`.
FN u32 find_leaf(leaf_cursor* w, cover c, u32 from, u32 end) {
    while (w->at < w->count && w->nodes[w->at] < from) ++w->at;
    if (w->at == w->count && w->more) fill_cursor(w, c, from, end);
    return w->at < w->count;
}

#define NEGATE_BIT 0x80000000u

// The value of a large term. The walk goes from covered leaf to covered leaf. A subtree without a covered leaf is false
// (there are no complements), so it is never entered. A right subtree whose value cannot matter is skipped, too. There
// is no recursion: a stack entry is an operator whose left operand is under evaluation. `negate` inverts the value of
// the current subtree. shared/layout.h says how the scene compiler keeps the stack short.
FN u32 walk_term(cover c, u32 node, u32 end) {
    u32 stack[TREE_STACK], ends[TREE_STACK];
    u32 depth = 0, negate = 0, value, term_end = end;
    leaf_cursor w;
    fill_cursor(&w, c, node, end);
    for (;;) {
        u32 word, op;
        if (!find_leaf(&w, c, node, term_end) || w.nodes[w.at] >= end) {
            value = negate;
        } else {
            word = c.trees[node];
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
                // The left operand is false.
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
            word = c.trees[entry & ~NEGATE_BIT];
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

#endif

FN u32 role_of(GLOBAL const u32* table, u32 shift, u32 solid) {
    const u32 last = 0xffffffffu >> shift;
    u32 place = place_of_role(solid, shift), entry = table[place];
    while (entry != NONE && (entry & TREE_MASK) != solid) {
        place = (place + 1) & last;
        entry = table[place];
    }
    return entry == NONE ? 0 : entry >> TREE_SHIFT;
}

// The term's value if roles decide it, else ROLE_UNDECIDED.
FN u32 ask_roles(GLOBAL const u32* roles, const covered_solids* list) {
    const u32 shift = roles[0], wanted = roles[1];
    u32 i, needed = 0, undecided = 0, blocked = 0;
    for (i = 0; i < list->count && !blocked; ++i) {
        const u32 role = role_of(roles + ROLES_HEADER, shift, list->solids[i]);
        blocked = role == ROLE_BLOCKS;
        needed |= role == ROLE_NEEDED;
        undecided |= role == ROLE_UNDECIDED;
    }
    if (blocked || (!undecided && wanted == NONE)) return 0;
    // A solid may be listed twice, so needed solids cannot be counted.
    return undecided || wanted != 1 ? ROLE_UNDECIDED : needed;
}

FN u32 term_holds(cover c, const covered_solids* list, StartRecord start) {
    const u32 size = start.end_word - start.first_word;
    u32 value = size == 1 ? 1u : within(start.needed, filter_of_covered(list)) ? ROLE_UNDECIDED : 0;
    if (value == ROLE_UNDECIDED && start.roles != NONE && list->count <= FEW)
        value = ask_roles(c.trees + start.roles, list);
    if (value == ROLE_UNDECIDED) {
#ifdef CSGRT_LARGE_TERMS
        value = size > SCANNED_WORDS ? walk_term(c, start.first_word, start.end_word)
                                     : scan_term(c, list, start.first_word, start.end_word);
#else
        value = scan_term(c, list, start.first_word, start.end_word);
#endif
    }
    return value;
}

// The claims of a partition: the region of the least number, and any other region of the same rank. NONE: there is
// none.
typedef struct {
    u32 least, other;
} claim;

FN SolidFilter all_solids(void) {
    SolidFilter f;
    f.even = f.odd = 0xffffffffu;
    return f;
}

// Evaluates the terms that start at the segments of `starting`, a subset of c.bits. `ranks`: Frame.rank_ends, or 0 if
// `other` is not wanted. `changed`: the solids that began or ceased to cover at the last event. If no region claimed
// before, only a term that has one of these solids can claim now. Several solids may start one term, as in a xor, and
// each would find the same value: a term that was false just now is not evaluated again.
FN claim find_claim(cover c, BOUNDARY_SPACE const u32* starting, const covered_solids* list, GLOBAL const u32* ranks,
                    SolidFilter changed) {
    claim found;
    u32 word, words = words_of(c.segments), refuted = NONE;
    found.least = found.other = NONE;
    for (word = 0; word < words; ++word) {
        u32 bits = starting[word];
        while (bits) {
            const u32 segment = take_segment_of(word, &bits), solid = c.boundaries[2 * segment].solid;
            u32 i = c.solids[solid].first_start, end = is_missed(c, segment) ? i : i + c.solids[solid].start_count;
            for (; i < end; ++i) {
                const StartRecord start = c.starts[i];
                const u32 region = start.region, precedes = region < found.least;
                const u32 wanted = precedes || (ranks && found.other == NONE && region != found.least &&
                                                same_rank(ranks, region, found.least));
                if (!wanted || start.first_word == refuted || !meet(start.solids, changed)) continue;
                if (term_holds(c, list, start)) {
                    const u32 later = precedes ? found.least : region;
                    if (precedes) found.least = region;
                    found.other = ranks && later != NONE && same_rank(ranks, later, found.least) ? later : NONE;
                } else {
                    refuted = start.first_word;
                }
            }
        }
    }
    return found;
}

// Are all listed segments of one solid?
FN u32 is_one_solid(const covered_solids* list) {
    u32 i;
    for (i = 1; i < list->count && i < FEW && list->solids[i] == list->solids[0]; ++i) {
    }
    return i == list->count;
}

// Finds the claim, as find_claim does, for a ray that runs in a face of a covering solid. `list`: the solids that
// c.bits cover; it is overwritten.
//
// Such a ray is moved to each of four sides, which are the same for all solids: above, below, left and right. On a side
// the moved ray is within only one of the solids that meet in a face, so solids that touch do not overlap, and their
// intersection is empty. The region of the least number on any side owns the partition, and an overlap is an overlap on
// this side. Around an edge there are as many wedges as faces meet there, so solids that fill less than a quarter of
// the turn may be on none of the sides. But if the ray touches one solid alone, it is not moved, and the solid covers
// it.
RARE_FN claim find_claim_of_sides(cover c, BOUNDARY_SPACE const u32* starting, covered_solids* list,
                                  GLOBAL const u32* ranks, SolidFilter changed) {
    const u32 moved = c.beyond || !is_one_solid(list) ? 1u : 0u;
    claim found;
    u32 side;
    found.least = found.other = NONE;
    for (side = moved; side < (moved ? SIDES : 1u); ++side) {
        claim here;
        c.missed = missed_on(side);
        if (moved) list_covered(c, list);
        here = find_claim(c, starting, list, ranks, changed);
        if ((here.least < found.least || (here.least == found.least && here.other < found.other)) &&
            !(c.missed & c.beyond))
            found = here;
    }
    return found;
}

// The claim of the partition that the segments of c.bits cover. `list`: the solids of these segments.
FN claim find_claim_beside(cover c, BOUNDARY_SPACE const u32* starting, covered_solids* list, GLOBAL const u32* ranks,
                           SolidFilter changed) {
    c.missed = 0;
    if (list->missed || c.beyond) return find_claim_of_sides(c, starting, list, ranks, changed);
    return find_claim(c, starting, list, ranks, changed);
}

#endif
