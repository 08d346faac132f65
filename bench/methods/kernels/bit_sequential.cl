// Jansen's bit-sequential evaluation. Tables 2, 3: of each region where its words begin, and one behind the last; the
// words in postorder: 2 bits the gate, then for a leaf 1 bit the complement and 29 bits the solid.
//
// Operands that hold more leaves come first, so a stack of 32 bits does for 2^31 leaves.
static u32 bit_sequential_holds(__global const u32* tables, const coverage* c, u32 region) {
    __global const u32* const firsts = tables + tables[2];
    __global const u32* const words = tables + tables[3];
    const u32 end = firsts[region + 1];
    u32 i, stack = 0;
    for (i = firsts[region]; i < end; ++i) {
        const u32 word = words[i], gate = word >> GATE_SHIFT;
        if (gate == GATE_LEAF) {
            stack = stack << 1 | (solid_covers(c, word & TREE_MASK) ^ (word >> TREE_SHIFT & 1u));
        } else {
            const u32 right = stack & 1u, left = stack >> 1 & 1u;
            const u32 value = gate == GATE_INTERSECTION ? left & right
                              : gate == GATE_UNION      ? left | right
                                                        : left ^ right;
            stack = (stack >> 1 & ~1u) | value;
        }
    }
    return stack & 1u;
}
