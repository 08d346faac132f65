// Finds the first row of each ray of a list, on processors, without segments in global memory. Packets of eight rays
// are traced from front to back, as the packets of a picture are (first_hits.cl). A list has no tiles, so each packet
// lists its nodes itself.
#include "shared/scene_args.h"
#include "packet/listed.h"
#include "packet/hits.h"

// The data of the test that finds which boxes the active rays meet within their ranges.
typedef struct {
    packet_slab_ray slabs;
    float8 range_end;
    u32 active_mask;
} packet_boxes;

// Returns where the first active ray enters the node's box; BOX_MISSED: none does. A box that is entered before a ray's
// range may hold a segment that begins even earlier.
static TileNode packet_entry(packet_boxes b, __global const BvhNode* nodes, u32 node) {
    float8 out, in = box_passage(b.slabs, nodes[node], &out);
    const int8 is_hit = in <= out && in <= b.range_end && of_bits(b.active_mask);
    float4 of4;
    float2 of2;
    TileNode e;
    in = in <= b.slabs.t_min ? (float8)(-BOX_MISSED) : in;
    in = is_hit ? in : (float8)(BOX_MISSED);
    of4 = in.lo < in.hi ? in.lo : in.hi;
    of2 = of4.lo < of4.hi ? of4.lo : of4.hi;
    e.node = node;
    e.entry = of2.x < of2.y ? of2.x : of2.y;
    return e;
}

// Lists nodes that hold everything that the rays meet, the nearest first, with an entry of no node at the end. The list
// is made from the root down, level by level, as kernel 0 makes a tile's.
static void list_packet_nodes(packet_boxes b, __global const BvhNode* nodes, u32 node_count,
                              __global TileNode* stored) {
    TileNode list[PACKET_NODES];
    u32 count = 0, split = 1, i, k;
    if (node_count) list[0] = packet_entry(b, nodes, 0);
    count = node_count && list[0].entry < BOX_MISSED;
    while (split) {
        const u32 end = count;
        split = 0;
        for (i = 0; i < end && count < PACKET_NODES - 1u; ++i) {
            TileNode first, second;
            if (nodes[list[i].node].leaf) continue;
            first = packet_entry(b, nodes, list[i].node + 1);
            second = packet_entry(b, nodes, nodes[list[i].node + 1].skip);
            list[i] = first.entry <= second.entry ? first : second;  // if both are missed, the entry is removed below
            if (first.entry < BOX_MISSED && second.entry < BOX_MISSED)
                list[count++] = first.entry <= second.entry ? second : first;
            split |= list[i].entry < BOX_MISSED;
        }
        for (i = k = 0; i < count; ++i)
            if (list[i].entry < BOX_MISSED) list[k++] = list[i];
        count = k;
    }
    for (i = 0; i < count; ++i) {
        const TileNode e = list[i];
        for (k = i; k > 0 && stored[k - 1].entry > e.entry; --k) stored[k] = stored[k - 1];
        stored[k] = e;
    }
    stored[count].node = NONE;
    stored[count].entry = BOX_MISSED;
}

static void start_listed(packet* p, __global const Frame* f, __global const RayRecord* rays, u32 id, ray_packet r) {
    real length[PACKET], shift[PACKET];
    u32 k;
    p->rays.o = r.rays.o;
    p->rays.d = r.rays.d;
    p->lanes = lanes_of(p->rays);
    p->t_min = r.t_min;
    p->slabs = make_slab_ray(offset_from(packet_make_wide3(f->center[0], f->center[1], f->center[2]), r.rays.o),
                             r.rays.d, f->radius, r.t_min);
    vstore8(p->slabs.length, 0, length);
    vstore8(p->slabs.shift, 0, shift);
    for (k = 0; k < PACKET; ++k) {
        const u32 ray = id + (r.within >> k & 1u ? k : 0);
        start_sweep(p->sweeps + k);
        p->next_events[k] = BOX_MISSED;
        p->units[k].after = rays[ray].t_near;
        p->units[k].tolerance = tolerance_along(f, geometry_ray(f, listed_ray(rays[ray])));
        p->units[k].unit = length[k];
        p->units[k].per_unit = 1 / length[k];
        p->units[k].offset = shift[k] - real_abs(shift[k]) * 0x1p-49;  // the rounding of a far origin: see
                                                                       // distance_before
    }
}

// Finds where the row of a ray begins whose first claim is known, as cut_row does (boolean/rows.h); *is_cut: the range
// cuts the row there. Returns 0 if the range holds nothing of the row.
static int begin_of_row(const sweep* w, RayRecord record, real* t, u32* is_cut) {
    *is_cut = w->goes_on || w->seen.t < record.t_near;
    *t = *is_cut ? record.t_near : w->seen.t;
    return record.t_near < record.t_far ? *t < record.t_far : *is_cut || *t <= record.t_near;
}

// Runs one work-item a packet. `lists`: memory for PACKET_NODES entries of each packet. For each ray `regions` gets the
// region, NONE or HIT_UNKNOWN; `seen_solids` gets NONE where the range cuts the row. `normals` may be 0.
__kernel void hit_listed_rays(__global const Frame* frame, GEOMETRY_ARGS, __global const BvhNode* nodes, REGION_ARGS,
                              __global const RayRecord* rays, __global TileNode* lists, __global u32* regions,
                              __global real* distances, __global u32* seen_solids, __global real* normals) {
    const u32 item = (u32)get_global_id(0), id = item * PACKET;
    const Geometry g = GEOMETRY;
    u32 overflow_mask, hit_mask, k;
    ray_packet r;
    packet_boxes b;
    scene_tables s;
    packet p;
    if (id >= frame->ray_count) return;
    r = listed_packet(frame, rays, id);
    start_listed(&p, frame, rays, id, r);
    b.slabs = p.slabs;
    b.range_end = end_of_range(p.slabs, frame->radius, r.t_max);
    b.active_mask = bits_of(p.slabs.hits_sphere) & r.within;
    lists += (size_t)item * PACKET_NODES;
    list_packet_nodes(b, nodes, b.active_mask ? frame->node_count : 0, lists);
    s.g = g;
    s.nodes = nodes;
    s.starts = starts;
    s.trees = trees;
    s.seen_end = frame->rank_ends[RANK_HIDDEN];
    hit_mask = first_hits_of(&p, frame, s, 0, lists, r.within, &overflow_mask);
    for (k = 0; k < PACKET && id + k < frame->ray_count; ++k) {
        const sweep* w = p.sweeps + k;
        const u32 ray = id + k;
        real t;
        u32 is_cut;
        regions[ray] = overflow_mask >> k & 1u ? HIT_UNKNOWN : NONE;
        if (!(hit_mask >> k & 1u) || !begin_of_row(w, rays[ray], &t, &is_cut)) continue;
        regions[ray] = w->region;
        distances[ray] = t;
        seen_solids[ray] = is_cut ? NONE : w->seen.solid;
        if (normals && !is_cut) {
            const vec3 n = normal_at(g, g.solids[w->seen.solid], lane(&p.lanes, k), w->seen.t, w->seen.surface);
            normals[3 * ray] = w->from_within ? -n.x : n.x;
            normals[3 * ray + 1] = w->from_within ? -n.y : n.y;
            normals[3 * ray + 2] = w->from_within ? -n.z : n.z;
        }
    }
}
