// The thesis's kernel 4, with switches (bench/methods/thesis.cpp). A work-item is a ray. The kernel of each switch has
// its switches as a constant, so that compilers remove the others' code.
//
// Tables:
//   2, 3   of each region where its words begin, and one behind the last; the words in depth-first order: 2 bits the
//          gate, 30 bits the place of the second operand; of a leaf 1 bit the complement, 29 bits the solid. The first
//          operand, that of fewer leaves, is the next word.
//   4      of each region 1 if its tree has only unions
//   5      how many regions, words of a ray's table of regions, 1 if first hits alone are wanted
// `memory`: of each ray its table of regions, then OWN_WORDS words for segments.
#define OWN_WORDS 256u
#define NEGATED 0x80000000u
#define PLACE_MASK 0x3fffffffu

#define SEARCH_REGIONS 1u
#define ONE_BY_ONE 2u
#define MAKE_BITS 4u
#define MAKE_LISTS 8u
#define LIST_REGIONS 16u
#define POSTFIX 32u
#define WALK_UNIONS 64u

typedef struct {
    coverage c;  // without its list and filter
    __global const u32* tables;
    __global u32 *regions, *own;
    u32 region_count, listed, own_count;  // listed: regions in a list
    u32 is_alone, first_solid;            // whether all covering segments are of one solid
} thesis_ray;

// As next_segment(): the thesis's walk over a bit array by clz, or its alternatives.
static u32 thesis_next(const thesis_ray* r, u32* at, u32 switches) {
    if (switches & MAKE_LISTS && r->own_count <= OWN_WORDS) {
        while (*at < r->own_count) {
            const u32 segment = r->own[(*at)++];
            if (!(r->c.boundaries[2 * segment].surface & r->c.missed)) return segment;
        }
        return NONE;
    }
    if (switches & ONE_BY_ONE) {
        while (*at < r->c.segments) {
            const u32 segment = (*at)++;
            if ((r->c.bits[segment >> 5] >> (segment & 31u) & 1u) &&
                !(r->c.boundaries[2 * segment].surface & r->c.missed))
                return segment;
        }
        return NONE;
    }
    return next_segment(&r->c, at);
}

// Inserts the covering segments into a bit array, or into a list that must not have one twice.
static void thesis_make_segments(thesis_ray* r, u32 switches) {
    u32 at = 0, i, segment;
    r->own_count = 0;
    if (switches & MAKE_BITS) {
        if (words_of(r->c.segments) > OWN_WORDS) return;
        for (i = 0; i < words_of(r->c.segments); ++i) r->own[i] = 0;
    }
    while ((segment = next_segment(&r->c, &at)) != NONE) {
        if (switches & MAKE_BITS) {
            r->own[segment >> 5] |= 1u << (segment & 31u);
        } else if (r->own_count <= OWN_WORDS) {
            for (i = 0; i < r->own_count && r->own[i] != segment; ++i) {
            }
            if (i < OWN_WORDS) r->own[i] = segment;
            if (i == r->own_count) ++r->own_count;  // above OWN_WORDS: not all are listed
        }
    }
    if (switches & MAKE_BITS) r->c.bits = r->own;
}

static u32 thesis_covers(const thesis_ray* r, u32 solid, u32 switches) {
    u32 at = 0, segment;
    while ((segment = thesis_next(r, &at, switches)) != NONE)
        if (r->c.boundaries[2 * segment].solid == solid) return 1;
    return 0;
}

static u32 thesis_leaf(const thesis_ray* r, u32 word, u32 switches) {
    return thesis_covers(r, word & TREE_MASK, switches) ^ (word >> TREE_SHIFT & 1u);
}

// All words from the last on: operands before gates.
static u32 thesis_postfix_value(const thesis_ray* r, u32 first, u32 end, u32 switches) {
    __global const u32* const words = r->tables + r->tables[3];
    u32 stack = 0;
    while (end > first) {
        const u32 word = words[--end], gate = word >> GATE_SHIFT;
        if (gate == GATE_LEAF) {
            stack = stack << 1 | thesis_leaf(r, word, switches);
        } else {
            const u32 a = stack & 1u, b = stack >> 1 & 1u;
            stack = (stack >> 1 & ~1u) | (gate == GATE_INTERSECTION ? a & b : gate == GATE_UNION ? a | b : a ^ b);
        }
    }
    return stack & 1u;
}

// Depth first; an operand that cannot change the value is skipped. The stack holds gates whose first operand is being
// evaluated: as many as the logarithm of the leaves.
static u32 thesis_value(const thesis_ray* r, u32 node, u32 switches) {
    __global const u32* const words = r->tables + r->tables[3];
    u32 stack[TREE_STACK], depth = 0, negate = 0;
    for (;;) {
        u32 word = words[node], value;
        if (word >> GATE_SHIFT != GATE_LEAF) {
            stack[depth++] = node | (negate ? NEGATED : 0u);
            negate = 0;
            ++node;
            continue;
        }
        value = thesis_leaf(r, word, switches) ^ negate;
        for (;;) {
            u32 outer, gate;
            if (depth == 0) return value;
            outer = stack[--depth] >> 31;
            word = words[stack[depth] & ~NEGATED];
            gate = word >> GATE_SHIFT;
            if (gate == GATE_UNION ? value : gate == GATE_INTERSECTION ? !value : 0u) {
                value ^= outer;
                continue;
            }
            node = word & PLACE_MASK;
            negate = gate == GATE_UNION || gate == GATE_INTERSECTION ? outer : outer ^ value;
            break;
        }
    }
}

static u32 thesis_claims(const thesis_ray* r, u32 region, u32 switches) {
    __global const u32* const firsts = r->tables + r->tables[2];
    if (!(switches & WALK_UNIONS) && r->tables[r->tables[4] + region]) return 1;
    return switches & POSTFIX ? thesis_postfix_value(r, firsts[region], firsts[region + 1], switches)
                              : thesis_value(r, firsts[region], switches);
}

static u32 thesis_tree_has(const thesis_ray* r, u32 region, u32 solid) {
    __global const u32* const firsts = r->tables + r->tables[2];
    __global const u32* const words = r->tables + r->tables[3];
    const u32 end = firsts[region + 1];
    u32 i;
    for (i = firsts[region]; i < end; ++i)
        if (words[i] >> GATE_SHIFT == GATE_LEAF && (words[i] & TREE_MASK) == solid) return 1;
    return 0;
}

static void thesis_insert(thesis_ray* r, u32 region, u32 switches) {
    if (switches & LIST_REGIONS) {
        u32 i;
        for (i = 0; i < r->listed; ++i)
            if (r->regions[i] == region) return;
        r->regions[r->listed++] = region;
    } else {
        r->regions[region >> 5] |= 1u << (region & 31u);
    }
}

// The table of the regions in whose trees covering solids stand.
static void thesis_make_regions(thesis_ray* r, u32 switches) {
    __global const u32* const firsts = r->tables + r->tables[0];
    __global const u32* const regions = r->tables + r->tables[1];
    u32 at = 0, segment, i;
    r->c.marked = 0;
    r->first_solid = NONE;
    r->is_alone = 1;
    while ((segment = thesis_next(r, &at, switches)) != NONE) {
        const Boundary end = r->c.boundaries[2 * segment];
        r->c.marked |= end.surface & MISSED;
        if (r->first_solid == NONE) r->first_solid = end.solid;
        r->is_alone &= end.solid == r->first_solid;
        if (switches & SEARCH_REGIONS) {
            for (i = 0; i < r->region_count; ++i)
                if (thesis_tree_has(r, i, end.solid)) thesis_insert(r, i, switches);
        } else {
            for (i = firsts[end.solid]; i < firsts[end.solid + 1]; ++i) thesis_insert(r, regions[i], switches);
        }
    }
}

// The least region of the table that holds. All are evaluated, as the thesis needs them to find overlaps. The table is
// empty afterwards.
static u32 thesis_least(thesis_ray* r, u32 switches) {
    u32 owner = NONE, i;
    if (switches & LIST_REGIONS) {
        for (i = 0; i < r->listed; ++i) {
            const u32 region = r->regions[i];
            if (thesis_claims(r, region, switches) && region < owner) owner = region;
        }
        r->listed = 0;
        return owner;
    }
    for (i = 0; i < words_of(r->region_count); ++i) {
        u32 bits = r->regions[i];
        if (bits == 0) continue;
        r->regions[i] = 0;
        for (; bits; bits &= bits - 1) {
            const u32 region = 32 * i + lowest(bits);
            if (thesis_claims(r, region, switches) && region < owner) owner = region;
        }
    }
    return owner;
}

static void thesis_evaluate(__global const Frame* frame, __global const RayCount* offsets,
                            __global const Boundary* all_boundaries, __global const u32* all_bits,
                            __global PartitionNode* all_nodes, __global const u32* tables, __global u32* memory,
                            u32 switches) {
    const u32 ray = (u32)get_global_id(0);
    __global const u32* const sizes = tables + tables[5];
    __global PartitionNode* nodes;
    RayCount offset;
    thesis_ray r;
    u32 k;
    if (ray >= frame->ray_count || !segments_fit(frame, offsets)) return;
    offset = offsets[ray];
    r.c.segments = offsets[ray + 1].segments - offset.segments;
    if (r.c.segments == 0) return;
    r.c.boundaries = all_boundaries + 2 * (size_t)offset.segments;
    nodes = all_nodes + 2 * (size_t)offset.segments;
    r.tables = tables;
    r.region_count = sizes[0];
    r.regions = memory + (size_t)ray * (sizes[1] + OWN_WORDS);
    r.own = r.regions + sizes[1];
    r.listed = 0;
    for (k = first_partition(nodes, r.c.segments); k != NONE; k = nodes[k].next) {
        u32 owner = NONE, side;
        r.c.missed = 0;
        r.c.bits = all_bits + offset.words + k * words_of(r.c.segments);
        if (!sizes[2] || r.c.boundaries[nodes[k].out_boundary].t > 0) {
            if (switches & (MAKE_BITS | MAKE_LISTS)) thesis_make_segments(&r, switches);
            thesis_make_regions(&r, switches);
            owner = thesis_least(&r, switches);
            if (r.c.marked && !r.is_alone) {  // to each side of the face that the ray runs in
                owner = NONE;
                for (side = 1; side < SIDES; ++side) {
                    u32 here;
                    r.c.missed = missed_on(side);
                    thesis_make_regions(&r, switches);
                    here = thesis_least(&r, switches);
                    if (here < owner) owner = here;
                }
            }
        }
        nodes[k].owner = owner;
        if (sizes[2] && owner != NONE) return;
    }
}

#define THESIS_KERNEL(name, switches)                                                                                \
    __kernel void name(__global const Frame* frame, __global const RayCount* offsets,                                \
                       __global const Boundary* boundaries, __global const u32* bits, __global PartitionNode* nodes, \
                       __global const u32* tables, __global u32* memory) {                                           \
        thesis_evaluate(frame, offsets, boundaries, bits, nodes, tables, memory, switches);                          \
    }

THESIS_KERNEL(thesis, 0u)
THESIS_KERNEL(thesis_searches_regions, SEARCH_REGIONS)
THESIS_KERNEL(thesis_without_clz, ONE_BY_ONE)
THESIS_KERNEL(thesis_makes_bits, MAKE_BITS)
THESIS_KERNEL(thesis_makes_lists, MAKE_LISTS)
THESIS_KERNEL(thesis_lists_regions, LIST_REGIONS)
THESIS_KERNEL(thesis_postfix, POSTFIX)
THESIS_KERNEL(thesis_walks_unions, WALK_UNIONS)
