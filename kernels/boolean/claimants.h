// Claimants: all regions that claim a partition which several regions of one rank claim (claim.h finds the first).
#ifndef CSGRT_BOOLEAN_CLAIMANTS_H
#define CSGRT_BOOLEAN_CLAIMANTS_H

#include "claim.h"

// Lists the regions whose terms hold on one side of a contact. A region may be listed several times. Returns the length
// of the list; stores the list from `found` on unless `found` is 0.
FN u32 list_claims(cover c, GLOBAL u32* found) {
    covered_solids covered;
    u32 word, words = words_of(c.segments), count = 0, known = NONE;  // known: the term that was evaluated last
    list_covered(c, &covered);
    for (word = 0; word < words; ++word) {
        u32 bits = c.bits[word];
        while (bits) {
            const u32 segment = take_segment_of(word, &bits), solid = c.boundaries[2 * segment].solid;
            u32 i = c.solids[solid].first_start, end = is_missed(c, segment) ? i : i + c.solids[solid].start_count;
            for (; i < end; ++i) {
                const StartRecord start = c.starts[i];
                if (start.first_word == known) continue;
                known = start.first_word;
                if (!term_holds(c, &covered, start)) continue;
                if (found) found[count] = start.region;
                ++count;
            }
        }
    }
    return count;
}

// The range of the sides to evaluate: the ray as it is, or the sides to which it is moved.
typedef struct {
    u32 first, end;
} side_range;
FN side_range sides_to_ask(cover c) {
    covered_solids covered;
    side_range sides;
    c.missed = 0;
    list_covered(c, &covered);
    sides.first = covered.missed && !is_one_solid(&covered) ? 1u : 0u;
    sides.end = sides.first ? SIDES : 1u;
    return sides;
}

// The most numbers that all_claimants() stores before it removes duplicates.
FN u32 claims_at_most(cover c) {
    const side_range sides = sides_to_ask(c);
    u32 side, count = 0;
    for (side = sides.first; side < sides.end; ++side) {
        c.missed = missed_on(side);
        count += list_claims(c, 0);
    }
    return count;
}

// Sorts numbers (by a heap: there may be thousands) and removes duplicates. Returns how many numbers are left.
FN u32 sort_numbers(GLOBAL u32* numbers, u32 count) {
    u32 heap = count / 2, end = count, kept = 0, i;
    while (end > 1) {
        u32 hole, child, number;
        if (heap > 0) {
            number = numbers[--heap];
        } else {
            number = numbers[--end];
            numbers[end] = numbers[0];
        }
        hole = heap;
        for (child = 2 * hole + 1; child < end; child = 2 * hole + 1) {
            if (child + 1 < end && numbers[child + 1] > numbers[child]) ++child;
            if (numbers[child] <= number) break;
            numbers[hole] = numbers[child];
            hole = child;
        }
        numbers[hole] = number;
    }
    for (i = 0; i < count; ++i)
        if (kept == 0 || numbers[kept - 1] != numbers[i]) numbers[kept++] = numbers[i];
    return kept;
}

// Lists the claimants of the first claimant's rank, ascending, on the side that find_claim_beside() takes. Returns
// their number; `found` has memory for claims_at_most() numbers.
FN u32 all_claimants(cover c, GLOBAL const u32* ranks, GLOBAL u32* found) {
    const side_range sides = sides_to_ask(c);
    u32 side, kept = 0, i;
    for (side = sides.first; side < sides.end; ++side) {
        GLOBAL u32* const here = found + kept;
        u32 count, of_rank = 0;
        c.missed = missed_on(side);
        count = sort_numbers(here, list_claims(c, here));
        while (of_rank < count && same_rank(ranks, here[0], here[of_rank])) ++of_rank;
        if (of_rank < 2 || (kept > 0 && !(here[0] < found[0] || (here[0] == found[0] && here[1] < found[1])))) continue;
        for (i = 0; i < of_rank; ++i) found[i] = here[i];
        kept = of_rank;
    }
    return kept;
}

#endif
