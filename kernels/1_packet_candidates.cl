// Kernel 1's first step on processors, for a picture's tiles and for lists: packets of eight rays list their
// candidates. Closed-form solids are intersected here, too. count_segments (1_count_segments.cl) does the rest: the
// candidates that packets cannot intersect. A list's packet is eight consecutive rays. Rays of different directions
// cost little more in a packet than alone.
//
//   count packet candidates -> (scan) -> list packet candidates -> count segments -> ...
#include "shared/capacity.h"
#include "shared/scene_args.h"
#include "geometry/collect.h"
#include "packet/listed.h"

// The index of a packet's ray k among the batch's rays. `id`: the packet's first work-item.
static u32 place_in_packet(__global const Frame* f, u32 id, u32 k) {
    return f->work == WORK_RAYS ? id + k : first_of_packet(id) + ray_of_packet(k);
}

static ray_packet packet_of(__global const Frame* f, __global const RayRecord* rays, __global const u32* listed,
                            u32 id) {
    ray_packet p;
    pixel_position first;
    if (f->work == WORK_RAYS) return listed_packet(f, rays, id);
    p.number = first_of_packet(number_of(f, listed, id));
    first = pixel_of(p.number, f->screen);
    p.rays = rays_through(f, first);
    p.t_min = range_in_view(f, p.rays).from;
    p.t_max = (double8)REAL_INFINITY;
    p.within = first.inside ? rays_inside(f, first) : 0;
    return p;
}

// The walk of a packet through the nodes of its tile's list, or through all nodes.
typedef struct {
    packet_slab_ray slabs;
    float8 range_end;
    __global const BvhNode* nodes;
    __global const TileNode* next;  // 0: there is no list
    bvh_cursor cursor;              // in the subtree of the node that was taken from the list last
    u32 active_mask;                // rays that pass near the scene
} packet_walk;

static packet_walk start_walk(__global const Frame* f, __global const BvhNode* nodes, __global const TileNode* lists,
                              ray_packet p) {
    packet_walk w;
    w.slabs = make_slab_ray(offset_from(packet_make_wide3(f->center[0], f->center[1], f->center[2]), p.rays.o),
                            p.rays.d, f->radius, f->whole_lines ? (double8)(-REAL_INFINITY) : p.t_min);
    w.range_end = end_of_range(w.slabs, f->radius, f->whole_lines ? (double8)(REAL_INFINITY) : p.t_max);
    w.nodes = nodes;
    w.next = lists ? list_of(f, lists, p.number) : 0;
    w.active_mask = bits_of(w.slabs.hits_sphere) & p.within;
    w.cursor = bvh_over(lists ? 0 : f->node_count);
    return w;
}

// The next leaf that any ray hits, as BvhNode.leaf; 0: there is none. *hit_mask: the rays that hit the leaf.
static u32 next_packet_leaf(packet_walk* w, u32* hit_mask) {
    u32 leaf = 0;
    if (w->active_mask && !w->next) {
        while (!leaf && bvh_goes_on(w->cursor)) {
            const BvhNode node = w->nodes[w->cursor.node];
            *hit_mask = bits_of(box_is_hit_before(w->slabs, node, w->range_end)) & w->active_mask;
            leaf = bvh_step(&w->cursor, node, *hit_mask != 0);
        }
        return leaf;
    }
    while (!leaf && w->active_mask && (bvh_goes_on(w->cursor) || w->next->node != NONE)) {
        if (!bvh_goes_on(w->cursor)) w->cursor = bvh_below(w->nodes, (w->next++)->node);
        leaf = next_leaf(w->slabs, w->nodes, &w->cursor, w->active_mask, hit_mask);
    }
    return leaf;
}

__kernel void count_packet_candidates(__global const Frame* frame, __global const BvhNode* nodes,
                                      __global const TileNode* lists, __global const RayRecord* rays,
                                      __global const u32* listed, __global CandidateCount* places) {
    const u32 id = (u32)get_global_id(0) * PACKET;
    ray_packet p;
    packet_walk w;
    u32 counts[PACKET], k, hit_mask, leaf;
    if (id >= frame->ray_count) return;
    p = packet_of(frame, rays, listed, id);
    for (k = 0; k < PACKET; ++k) counts[k] = p.within >> k & 1u ? frame->unbounded_count : 0;
    if (p.within) {
        w = start_walk(frame, nodes, lists, p);
        while ((leaf = next_packet_leaf(&w, &hit_mask)))
            for (k = 0; k < PACKET; ++k) counts[k] += hit_mask >> k & 1u ? leaf & BVH_LEAF_MASK : 0;
    }
    for (k = 0; k < PACKET && id + k < frame->ray_count; ++k) {
        const u32 place = place_in_packet(frame, id, k);
        places[place].candidates = counts[k];
        places[place].unused = 0;
    }
}

// A packet's rays, and where their candidates are stored.
typedef struct {
    packet_ray3 rays;
    double8 t_min;
    u32 ray[PACKET];   // a ray's index in the batch
    u32 next[PACKET];  // its next candidate
    __global Candidate* candidates;
    __global Boundary* found;
} packet_list;

// Adds a solid to the candidates of the active rays.
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
        c.ray = list->ray[k];
        c.solid = index;
        c.count = alone >> k & 1u ? UNCOUNTED : met >> k & 1u;
        c.before = 0;
        list->candidates[place] = c;
        if (met >> k & 1u)
            put_segment(list->found + 2 * (size_t)place, index, in[k], (u32)in_surface[k], out[k], (u32)out_surface[k]);
    }
}

__kernel void list_packet_candidates(__global const Frame* frame, GEOMETRY_ARGS, __global const BvhNode* nodes,
                                     __global const TileNode* lists, __global const RayRecord* rays,
                                     __global const u32* listed, __global const CandidateCount* places,
                                     __global Candidate* candidates, __global Boundary* found) {
    const u32 id = (u32)get_global_id(0) * PACKET;
    const Geometry g = GEOMETRY;
    ray_packet p;
    packet_list list;
    packet_walk w;
    u32 hit_mask, leaf, k, any = 0;
    if (id >= frame->ray_count || !candidates_of(frame, places)) return;
    for (k = 0; k < PACKET && id + k < frame->ray_count; ++k) {
        const u32 ray = list.ray[k] = place_in_packet(frame, id, k);
        list.next[k] = places[ray].candidates;
        any |= places[ray + 1].candidates != list.next[k];
    }
    if (!any) return;
    p = packet_of(frame, rays, listed, id);
    list.rays.o = p.rays.o;
    list.rays.d = p.rays.d;
    list.t_min = p.t_min;
    list.candidates = candidates;
    list.found = found;
    for (k = 0; k < frame->unbounded_count; ++k) list_solid(&list, g, k, p.within);
    w = start_walk(frame, nodes, lists, p);
    while ((leaf = next_packet_leaf(&w, &hit_mask))) {
        const u32 begin = leaf >> BVH_LEAF_SHIFT, end = begin + (leaf & BVH_LEAF_MASK);
        for (k = begin; k < end; ++k) list_solid(&list, g, k, hit_mask);
    }
}
