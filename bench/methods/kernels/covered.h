// What covers a partition, for kernels in place of kernel 4. They stand behind csgrt's own kernels in one program, so
// shared/layout.h is there. None of this is kernel 4's (boolean/claim.h), which it judges.
//
// `tables` is one buffer; its first words say where each table begins:
//   0, 1   of each solid where its regions begin, and one behind the last; the regions, ascending
//   2 ...  the method's own
#define LISTED_SOLIDS 32u

// In the two high bits of a word, as bench/methods/gate.hpp numbers them; any other gate is xor.
#define GATE_SHIFT 30
#define GATE_LEAF 0u
#define GATE_UNION 1u
#define GATE_INTERSECTION 2u

typedef struct {
    __global const Boundary* boundaries;
    __global const u32* bits;  // of segments
    u32 segments;
    u32 missed;  // MISSED_...: segments whose ends have any of these do not cover it
    u32 count;   // of the list, repeats counted; more than LISTED_SOLIDS: it is not complete
    u32 marked;  // MISSED_... of all covering segments
    u32 filter;  // a bit of each covering solid, which others may share
    u32 solids[LISTED_SOLIDS];
} coverage;

#define FILTER_BIT(solid) (1u << ((solid)&31u))

// The next covering segment from *at on, which moves behind it; NONE: there is none.
static u32 next_segment(const coverage* c, u32* at) {
    while (*at < c->segments) {
        const u32 word = c->bits[*at >> 5] >> (*at & 31u);
        u32 segment;
        if (word == 0) {
            *at = (*at | 31u) + 1;
            continue;
        }
        segment = *at + lowest(word);
        *at = segment + 1;
        if (segment < c->segments && !(c->boundaries[2 * segment].surface & c->missed)) return segment;
    }
    return NONE;
}

// Lists the solids but those whose ends have any of `missed`.
static void list_coverage(coverage* c, u32 missed) {
    u32 at = 0, segment;
    c->missed = missed;
    c->count = c->marked = c->filter = 0;
    while ((segment = next_segment(c, &at)) != NONE) {
        const Boundary end = c->boundaries[2 * segment];
        c->marked |= end.surface & MISSED;
        c->filter |= FILTER_BIT(end.solid);
        if (c->count < LISTED_SOLIDS) c->solids[c->count] = end.solid;
        ++c->count;
    }
}

// Goes through the covering solids, ascending; one with several segments may come more than once. NONE: no more.
static u32 next_solid(const coverage* c, u32* at) {
    u32 segment;
    if (c->count <= LISTED_SOLIDS) return *at < c->count ? c->solids[(*at)++] : NONE;
    segment = next_segment(c, at);
    return segment == NONE ? NONE : c->boundaries[2 * segment].solid;
}

static u32 is_alone(const coverage* c) {
    u32 i;
    for (i = 1; i < c->count && i < LISTED_SOLIDS && c->solids[i] == c->solids[0]; ++i) {
    }
    return i == c->count;
}

static u32 solid_covers(const coverage* c, u32 solid) {
    u32 low = 0, high = c->segments, at;
    if (!(c->filter & FILTER_BIT(solid))) return 0;
    if (c->count <= LISTED_SOLIDS) {
        while (low < c->count && c->solids[low] != solid) ++low;
        return low < c->count;
    }
    while (low < high) {  // a ray's ends stand by ascending solid
        const u32 middle = (low + high) >> 1;
        if (c->boundaries[2 * middle].solid < solid) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    at = low;
    low = next_segment(c, &at);
    return low != NONE && c->boundaries[2 * low].solid == solid;
}

// The first place from `low` on, before `high`, whose value is not less.
static u32 lower_bound(__global const u32* values, u32 low, u32 high, u32 value) {
    while (low < high) {
        const u32 middle = (low + high) >> 1;
        if (values[middle] < value) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

// The least region from `from` on in whose tree a covering solid stands; NONE: there is none.
static u32 next_region(__global const u32* tables, const coverage* c, u32 from) {
    __global const u32* const firsts = tables + tables[0];
    __global const u32* const regions = tables + tables[1];
    u32 least = NONE, at = 0, solid;
    while ((solid = next_solid(c, &at)) != NONE) {
        const u32 end = firsts[solid + 1], place = lower_bound(regions, firsts[solid], end, from);
        if (place < end && regions[place] < least) least = regions[place];
    }
    return least;
}
