// Jansen's bit-parallel evaluation. All gates of a level are evaluated at once, in the bits of a word:
//
//   S           a b c d      leaf bits; a gate's result stands in the bit of its right operand
//   S<<1          a b c
//   level 1     . ab . cd    S = S or S<<1, where the level's masks say so: and, xor
//   level 2     . . . abcd   the same with S<<2
//
// A tree is cut into pieces of at most 32 leaves, from the leaves up; a piece's result is a leaf of the piece above it.
// Tables:
//   2  of each region its first piece, and one behind the last; pieces that are needed stand before those that need
//   them 3  of each piece PIECE_WORDS: complemented leaves, leaves that are pieces' results, levels, then of each level
//   the
//      mask of and and of xor (all other bits are or, which is what padding needs: its bits are 0); leaves that are
//      solids, and where these begin in table 6
//   4  of each solid where its leaves begin, and one behind the last
//   5  the leaves: piece << 5 | bit, ascending
//   6  of each piece its solids, by ascending bit
// Results of pieces stand on a stack of bits.
#define PIECE_WORDS 15u
#define STACK_WORDS 4u

static u32 bit_parallel_holds(__global const u32* tables, const coverage* c, u32 region) {
    __global const u32* const firsts = tables + tables[4];
    __global const u32* const leaves = tables + tables[5];
    const u32 end = tables[tables[2] + region + 1];
    u32 piece, s = 0, height = 0, stack[STACK_WORDS];
    for (piece = tables[tables[2] + region]; piece < end; ++piece) {
        __global const u32* const words = tables + tables[3] + piece * PIECE_WORDS;
        const u32 levels = words[2];
        u32 results = words[1], at = 0, solid, level;
        s = 0;
        if (c->count < popcount(words[13])) {
            while ((solid = next_solid(c, &at)) != NONE) {
                const u32 last = firsts[solid + 1];
                u32 leaf = lower_bound(leaves, firsts[solid], last, piece << 5);
                for (; leaf < last && leaves[leaf] >> 5 == piece; ++leaf) s |= 1u << (leaves[leaf] & 31u);
            }
        } else {
            __global const u32* next = tables + tables[6] + words[14];
            u32 bits = words[13];
            for (; bits; bits &= bits - 1) s |= solid_covers(c, *next++) << lowest(bits);
        }
        while (results) {  // the last piece's result is that of the highest bit
            const u32 bit = 31u - clz(results);
            results ^= 1u << bit;
            --height;
            s |= (stack[height >> 5] >> (height & 31u) & 1u) << bit;
        }
        s ^= words[0];
        for (level = 0; level < levels; ++level) {
            const u32 right = s << (1u << level), both = words[3 + 2 * level], odd = words[4 + 2 * level];
            s = ((s | right) & ~(both | odd)) | (s & right & both) | ((s ^ right) & odd);
        }
        s = s >> ((1u << levels) - 1u) & 1u;
        if (height % 32u == 0) stack[height >> 5] = 0;
        stack[height >> 5] = (stack[height >> 5] & ~(1u << (height & 31u))) | s << (height & 31u);
        ++height;
    }
    return s;
}
