// Kernel 0 of first hits on a GPU: as 0_cull_blocks.cl, but a block is several work-items', which look at its nodes side by side: one
// alone takes a third of a small picture's time. The same nodes.
//
//   level      a        b        c        an item each: which children the beam meets
//            a0  a1   b0  -    -  -
//   next     a0  b0  a1                   first those that take their parent's place, then second children
#include "tally.h"

#define GROUP_BLOCKS (LOCKSTEP / CULL_ITEMS)
#define ITEM_NODES (LISTED_NODES / CULL_ITEMS)

// Of a block: the nodes of a level of the hierarchy, and of the next one. Of bits, k is that of the level's entry k.
typedef struct {
    BlockNode nodes[2][LISTED_NODES];
    u32 count;
    u32 both;   // the beam meets both children
    u32 split;  // there is room for them, if it does: they take the entry's place
    u32 stay;   // the entry has some place on the next level, its own or a child's
    u32 cost;
} shared_list;

// Of one of the level's entries.
typedef struct {
    BlockNode node, first, second;
} expansion;

FN u32 bit_of(u32 k) { return 1u << k; }
FN u32 how_many_before(u32 bits, u32 k) { return popcount(bits & (bit_of(k) - 1u)); }

static int is_met(BlockNode e) { return e.entry < BOX_MISSED; }

// As list_nodes() goes down a level: entries give way to their children in turn, as long as there is room for second ones. Every item
// of the group comes here with its block; `goes_on`: does any of the blocks have another level.
static void split_level(__local shared_list* own, u32 level, beam b, __global const BvhNode* nodes, u32 lane, __local u32* goes_on) {
    __local const BlockNode* const list = own->nodes[level & 1u];
    __local BlockNode* const next = own->nodes[(level & 1u) ^ 1u];
    const u32 count = own->count;
    expansion e[ITEM_NODES];
    u32 inner = 0, both = 0, split = 0, stay = 0, i;
    for (i = 0; i < ITEM_NODES; ++i) {
        const u32 k = i * CULL_ITEMS + lane;
        if (k < count) {
            e[i].node = list[k];
            if (!nodes[e[i].node.node].leaf) {
                e[i].first = entry_of(b, nodes, e[i].node.node + 1);
                e[i].second = entry_of(b, nodes, nodes[e[i].node.node + 1].skip);
                inner |= bit_of(k);
                if (is_met(e[i].first) && is_met(e[i].second)) both |= bit_of(k);
            }
        }
    }
    if (both) atomic_or(&own->both, both);
    barrier(CLK_LOCAL_MEM_FENCE);
    both = own->both;
    for (i = 0; i < ITEM_NODES; ++i) {
        const u32 k = i * CULL_ITEMS + lane;
        if (k < count) {
            const int gives_way = (inner & bit_of(k)) && count + how_many_before(both, k) < LISTED_NODES - 1;
            if (gives_way) split |= bit_of(k);
            if (!gives_way || is_met(e[i].first) || is_met(e[i].second)) stay |= bit_of(k);
        }
    }
    if (stay) atomic_or(&own->stay, stay);
    if (split) atomic_or(&own->split, split);
    if (split) *goes_on = 1;
    barrier(CLK_LOCAL_MEM_FENCE);
    split = own->split;
    stay = own->stay;
    both &= split;
    for (i = 0; i < ITEM_NODES; ++i) {
        const u32 k = i * CULL_ITEMS + lane;
        if (stay & bit_of(k))
            next[how_many_before(stay, k)] = !(split & bit_of(k)) ? e[i].node : is_met(e[i].first) ? e[i].first : e[i].second;
        if (both & bit_of(k)) next[popcount(stay) + how_many_before(both, k)] = e[i].second;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (lane == 0) {
        own->count = popcount(stay) + popcount(both);
        own->both = own->split = own->stay = 0;
    }
}

static void store_by_distance(__local const BlockNode* list, u32 count, u32 lane, __global BlockNode* stored) {
    u32 i, k;
    for (i = lane; i < count; i += CULL_ITEMS) {
        const BlockNode e = list[i];
        u32 place = 0;
        for (k = 0; k < count; ++k) place += list[k].entry < e.entry || (list[k].entry == e.entry && k < i);
        stored[place] = e;
    }
    if (lane == 0) {
        stored[count].node = NONE;
        stored[count].entry = BOX_MISSED;
    }
}

// CULL_ITEMS work-items are a block: what it costs, 0 if none of its rays meets a solid, and its LISTED_NODES, nearest first. `first`: as
// cull_blocks() has it.
__kernel __attribute__((reqd_work_group_size(LOCKSTEP, 1, 1))) void cull_blocks_together(
    __global const Frame* frame, __global const BvhNode* nodes, __global unsigned char* costs, __global BlockNode* lists,
    __global TileTally* tally, u32 first) {
    __local shared_list all[GROUP_BLOCKS];
    __local u32 goes_on;
    const u32 item = (u32)get_local_id(0), lane = item % CULL_ITEMS, blocks = frame->ray_count / (BLOCK * BLOCK);
    const u32 number = first + (u32)get_global_id(0), id = number / CULL_ITEMS;
    const int is_block = id < blocks;
    __local shared_list* const own = all + item / CULL_ITEMS;
    const beam b = make_beam(frame, frame->first_ray / (BLOCK * BLOCK) + (is_block ? id : 0));
    u32 level = 0, going = 1, i;
    clear_tally(tally, blocks, number);
    if (lane == 0) {
        own->count = own->both = own->split = own->stay = own->cost = 0;
        if (is_block && b.slabs.hits_sphere && frame->node_count > 0) {
            own->nodes[0][0] = entry_of(b, nodes, 0);
            own->count = is_met(own->nodes[0][0]);
        }
    }
    while (going) {
        if (item == 0) goes_on = 0;
        barrier(CLK_LOCAL_MEM_FENCE);
        split_level(own, level, b, nodes, lane, &goes_on);
        going = goes_on;
        barrier(CLK_LOCAL_MEM_FENCE);
        ++level;
    }
    {
        __local BlockNode* const list = own->nodes[level & 1u];
        const u32 count = own->count;
        for (i = lane; i < count; i += CULL_ITEMS) {
            list[i].entry = entry_from_center(b, list[i].entry);
            atomic_add(&own->cost, nodes[list[i].node].skip - list[i].node);
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        if (!is_block) return;
        store_by_distance(list, count, lane, lists + (size_t)id * LISTED_NODES);
        if (lane == 0) costs[id] = (unsigned char)(min(own->cost, 254u) + (frame->unbounded_count > 0));
    }
}
