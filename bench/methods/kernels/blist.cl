// Rossignac's Blist as code that jumps: a leaf has a solid, a sign and two successors, one for true and one for false.
// Nothing is kept but the place in the list. Tables 2, 3: of each region where its leaves begin, and one behind the
// last; the leaves, three words each: complement << 29 | solid, the successor on true, and on false.
#define BLIST_TRUE 0xffffffffu
#define BLIST_FALSE 0xfffffffeu

static u32 blist_holds(__global const u32* tables, const coverage* c, u32 region) {
    __global const u32* const leaves = tables + tables[3];
    u32 at = tables[tables[2] + region];
    while (at < BLIST_FALSE) {
        __global const u32* const leaf = leaves + 3 * at;
        const u32 word = leaf[0];
        at = solid_covers(c, word & TREE_MASK) ^ (word >> TREE_SHIFT & 1u) ? leaf[1] : leaf[2];
    }
    return at == BLIST_TRUE;
}
