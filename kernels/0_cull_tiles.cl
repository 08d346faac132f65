// Kernel 0: finds the tiles of a picture that can see anything. The other tiles get no rays. For each tile the kernel
// also lists the nodes of the hierarchy that the tile's 64 rays may meet, so that each ray tests the listed nodes
// alone. For every partition a GPU makes no lists.
#include "traversal/beam.h"
#include "traversal/bvh_cursor.h"

// Clears the report: nothing is counted yet, and no tile shows anything.
static void clear_report(__global BatchReport* report, u32 tiles, u32 id) {
    u32 k;
    for (k = id; k < sizeof(BatchReport) / sizeof(u32); k += (u32)get_global_size(0)) ((__global u32*)report)[k] = 0;
    if (id < tiles) ((__global unsigned char*)(report + 1))[id] = 0;
}

// Lists nodes that hold everything that the beam meets. The list begins with the root and goes down level by level.
// Until it is full, each inner node is replaced by the children that the beam meets. `entry` is at first a distance
// along the beam's middle ray, as in slab_ray.
static u32 list_nodes(beam b, __global const BvhNode* nodes, TileNode* list) {
    u32 count, k, split = 1;
    list[0] = entry_of(b, nodes, 0);
    count = list[0].entry < BOX_MISSED;
    while (split) {
        const u32 end = count;
        u32 kept = 0;
        split = 0;
        for (k = 0; k < end; ++k) {
            const TileNode e = list[k];
            TileNode first, second;
            if (nodes[e.node].leaf || count == LISTED_NODES - 1) {
                list[kept++] = e;
                continue;
            }
            first = entry_of(b, nodes, e.node + 1);
            second = entry_of(b, nodes, nodes[e.node + 1].skip);
            split = 1;
            if (first.entry < BOX_MISSED) list[kept++] = first;
            if (second.entry < BOX_MISSED) {
                if (first.entry < BOX_MISSED) {
                    list[count++] = second;
                } else {
                    list[kept++] = second;
                }
            }
        }
        for (k = end; k < count; ++k) list[kept++] = list[k];
        count = kept;
    }
    return count;
}

// Stores the list, sorted by distance or in the order of the hierarchy.
static void store_sorted(beam b, TileNode* list, u32 count, int by_distance, __global TileNode* stored) {
    u32 i, k;
    for (i = 0; i < count; ++i) {
        TileNode e = list[i];
        e.entry = entry_from_center(b, e.entry);
        for (k = i; k > 0; --k) {
            const TileNode before = list[k - 1];
            if (by_distance ? before.entry <= e.entry : before.node < e.node) break;
            list[k] = before;
        }
        list[k] = e;
    }
    for (i = 0; i < count; ++i) stored[i] = list[i];
    stored[count].node = NONE;
    stored[count].entry = BOX_MISSED;
}

// Counts the listed nodes and all nodes below them, up to 254. The time of a tile's rays is about proportional to the
// count. 0: no solid of the nodes starts a term.
static u32 count_nodes(__global const Frame* frame, __global const BvhNode* nodes,
                       __global const unsigned char* starting, const TileNode* list, u32 count) {
    u32 i, sum = 0, starts = 0;
    for (i = 0; i < count; ++i) {
        const u32 end = nodes[list[i].node].skip;
        sum += end - list[i].node;
        starts |= starting && !frame->every_partition ? starting[list[i].node] : end > frame->starting_node;
    }
    return !starts ? 0 : sum < 254 ? sum : 254;
}

// Returns 1 if the beam meets any leaf.
static u32 meets_anything(beam b, __global const BvhNode* nodes, u32 count) {
    bvh_cursor c = bvh_over(count);
    while (bvh_goes_on(c)) {
        const BvhNode node = nodes[c.node];
        if (bvh_step(&c, node, beam_entry(b, node) < BOX_MISSED)) return 1;
    }
    return 0;
}

// Runs one work-item a tile. Stores the tile's cost, 0 if none of its rays meets a solid that can be seen. Stores the
// tile's list of at most LISTED_NODES nodes, too, unless `lists` is 0. `starting`: for each node whether a solid of it
// starts a term; 0: those from the starting node on do. `ends`: for each tile of the screen, the
// distance from the eye behind which nothing of it is wanted; 0: everything is.
__kernel void cull_tiles(__global const Frame* frame, __global const BvhNode* nodes,
                         __global const unsigned char* starting, __global const float* ends,
                         __global unsigned char* costs, __global TileNode* lists, __global BatchReport* report) {
    const u32 id = (u32)get_global_id(0), tiles = frame->ray_count / (TILE * TILE);
    u32 cost = 0;
    beam b;
    if (frame->rows) clear_report(report, tiles, id);
    if (id >= tiles) return;
    b = make_beam(frame, frame->first_ray / (TILE * TILE) + id);
    if (ends) end_beam(&b, frame, ends[frame->first_ray / (TILE * TILE) + id]);
    if (lists) {
        TileNode list[LISTED_NODES - 1];
        u32 count = 0;
        if (b.slabs.hits_sphere && frame->node_count > 0) count = list_nodes(b, nodes, list);
        store_sorted(b, list, count, !frame->every_partition, lists + (size_t)id * LISTED_NODES);
        cost = count_nodes(frame, nodes, starting, list, count);
    } else if (b.slabs.hits_sphere) {
        cost = meets_anything(b, nodes, frame->node_count);
    }
    costs[id] = (unsigned char)(cost + (frame->unbounded_count > 0));
}
