// Kernel 1's first step on processors, for a picture's tiles: packets of eight rays list their candidates. Solids
// that packets know are intersected here, too; count_segments (1_count_segments.cl) is left with what one ray alone
// can answer.
//
//   count packet candidates -> (scan) -> list packet candidates -> count segments -> ...
#include "shared/capacity.h"
#include "shared/scene_args.h"
#include "geometry/collect.h"
#include "packet/packet.h"

// A packet on its way through the nodes of its tile's list.
typedef struct {
    packet_slab_ray slabs;
    __global const BvhNode* nodes;
    __global const TileNode* next;
    bvh_cursor cursor;  // in the subtree of the list's last node
    u32 active_mask;    // rays that pass near the scene
} packet_walk;

static packet_walk start_walk(__global const Frame* f, __global const BvhNode* nodes, __global const TileNode* list,
                              packet_world_ray r, u32 within) {
    packet_walk w;
    w.slabs = slabs_of(f, r);
    w.nodes = nodes;
    w.next = list;
    w.active_mask = bits_of(w.slabs.hits_sphere) & within;
    w.cursor = bvh_over(0);
    return w;
}

// The next leaf that any ray hits, as BvhNode has it, and the mask of those that do; 0: there is none.
static u32 next_packet_leaf(packet_walk* w, u32* hit_mask) {
    u32 leaf = 0;
    while (!leaf && w->active_mask && (bvh_goes_on(w->cursor) || w->next->node != NONE)) {
        if (!bvh_goes_on(w->cursor)) w->cursor = bvh_below(w->nodes, (w->next++)->node);
        leaf = next_leaf(w->slabs, w->nodes, &w->cursor, w->active_mask, hit_mask);
    }
    return leaf;
}

__kernel void count_packet_candidates(__global const Frame* frame, __global const BvhNode* nodes,
                                      __global const TileNode* lists, __global const u32* listed,
                                      __global CandidateCount* places) {
    const u32 id = (u32)get_global_id(0) * PACKET;
    pixel_position first;
    u32 counts[PACKET], number, k;
    if (id >= frame->ray_count) return;
    number = first_of_packet(number_of(frame, listed, id));
    first = pixel_of(number, frame->screen);
    for (k = 0; k < PACKET; ++k) counts[k] = 0;
    if (first.inside) {
        const u32 within = rays_inside(frame, first);
        packet_walk w = start_walk(frame, nodes, list_of(frame, lists, number), rays_through(frame, first), within);
        u32 hit_mask, leaf;
        for (k = 0; k < PACKET; ++k) counts[k] = within >> k & 1u ? frame->unbounded_count : 0;
        while ((leaf = next_packet_leaf(&w, &hit_mask)))
            for (k = 0; k < PACKET; ++k) counts[k] += hit_mask >> k & 1u ? leaf & BVH_LEAF_MASK : 0;
    }
    for (k = 0; k < PACKET; ++k) {
        const u32 place = first_of_packet(id) + ray_of_packet(k);
        places[place].candidates = counts[k];
        places[place].unused = 0;
    }
}

// Where a packet's candidates are stored.
typedef struct {
    packet_ray3 rays;
    real t_min;
    u32 ray;           // the first one's place
    u32 next[PACKET];  // a ray's next candidate
    __global Candidate* candidates;
    __global End* found;
} packet_list;

// A solid becomes a candidate of the active rays.
static void list_solid(packet_list* list, Geometry g, u32 index, u32 active_mask) {
    const SolidRecord solid = g.solids[index];
    real in[PACKET], out[PACKET];
    ulong in_surface[PACKET], out_surface[PACKET];
    u32 met = 0, alone = active_mask;
    if ((active_mask & (active_mask - 1u)) && takes_packets(solid)) {
        const packet_segments h = packet_intersect(g, solid, list->rays);
        met = bits_of(h.count == 1 && h.out0 >= list->t_min) & active_mask;
        alone &= bits_of(h.count == UNDECIDED);
        vstore8(h.in0, 0, in);
        vstore8(h.out0, 0, out);
        vstore8(h.in0_surface, 0, in_surface);
        vstore8(h.out0_surface, 0, out_surface);
    }
    for (; active_mask; active_mask &= active_mask - 1u) {
        const u32 k = lowest(active_mask), place = list->next[k]++;
        Candidate c;
        c.ray = list->ray + ray_of_packet(k);
        c.solid = index;
        c.count = alone >> k & 1u ? UNCOUNTED : met >> k & 1u;
        c.before = 0;
        list->candidates[place] = c;
        if (met >> k & 1u)
            put_segment(list->found + 2 * (size_t)place, index, in[k], (u32)in_surface[k], out[k], (u32)out_surface[k]);
    }
}

__kernel void list_packet_candidates(__global const Frame* frame, GEOMETRY_ARGS, __global const BvhNode* nodes,
                                     __global const TileNode* lists, __global const u32* listed,
                                     __global const CandidateCount* places, __global Candidate* candidates,
                                     __global End* found) {
    const u32 id = (u32)get_global_id(0) * PACKET;
    const Geometry g = GEOMETRY;
    packet_world_ray from_eye;
    packet_list list;
    packet_walk w;
    pixel_position first;
    u32 number, within, hit_mask, leaf, k, any = 0;
    if (id >= frame->ray_count || !candidates_of(frame, places)) return;
    list.ray = first_of_packet(id);
    for (k = 0; k < PACKET; ++k) {
        const u32 ray = list.ray + ray_of_packet(k);
        list.next[k] = places[ray].candidates;
        any |= places[ray + 1].candidates != list.next[k];
    }
    if (!any) return;
    number = first_of_packet(number_of(frame, listed, id));
    first = pixel_of(number, frame->screen);
    within = rays_inside(frame, first);
    from_eye = rays_through(frame, first);
    list.rays.o = from_eye.o;
    list.rays.d = from_eye.d;
    list.t_min = frame->t_min;
    list.candidates = candidates;
    list.found = found;
    for (k = 0; k < frame->unbounded_count; ++k) list_solid(&list, g, k, within);
    w = start_walk(frame, nodes, list_of(frame, lists, number), from_eye, within);
    while ((leaf = next_packet_leaf(&w, &hit_mask))) {
        const u32 begin = leaf >> BVH_LEAF_SHIFT, end = begin + (leaf & BVH_LEAF_MASK);
        for (k = begin; k < end; ++k) list_solid(&list, g, k, hit_mask);
    }
}
