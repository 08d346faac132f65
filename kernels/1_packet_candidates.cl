// Kernel 1's first step on processors, for the rays of a picture's blocks: which solids may they meet, eight rays at once. What it
// leaves is what find_candidates does (1_count_hits.cl).
#include "packet.h"

// A packet's candidates: how many each ray has, and where they go, if anywhere.
typedef struct {
    u32 first_ray;
    u32 counts[PACKET];
    __global const RayCount* places;
    __global Candidate* candidates;  // 0: they are counted
} packet_candidates;

static void add_candidate(packet_candidates* found, u32 solid, u32 which) {
    for (; which; which &= which - 1u) {
        const u32 k = lowest(which);
        if (found->candidates) {
            Candidate c;
            c.ray = found->first_ray + k;
            c.solid = solid;
            c.count = c.before = 0;
            found->candidates[found->places[c.ray].segments + found->counts[k]] = c;
        }
        ++found->counts[k];
    }
}

// Those that the rays of `which` may meet in a subtree.
static void add_subtree(packet_candidates* found, packet_slab_ray slabs, __global const BvhNode* nodes, u32 root, u32 which) {
    const u32 end = nodes[root].skip;
    u32 i = root;
    while (i < end) {
        const BvhNode node = nodes[i];
        const u32 hit = bits_of(box_is_hit(slabs, node)) & which;
        if (hit && node.leaf) {
            const u32 first = node.leaf >> BVH_LEAF_SHIFT, last = first + (node.leaf & BVH_LEAF_MASK);
            u32 solid;
            for (solid = first; solid < last; ++solid) add_candidate(found, solid, hit);
        }
        i = hit && !node.leaf ? i + 1 : node.skip;
    }
}

__kernel void find_packet_candidates(__global const Frame* frame, __global const BvhNode* nodes, __global const BlockNode* lists,
                                     __global const RayRecord* rays, __global RayCount* places, __global Candidate* candidates) {
    const u32 id = (u32)get_global_id(0) * PACKET;
    packet_candidates found;
    pixel_position first;
    u32 number, k;
    if (id >= frame->ray_count || (candidates && places[id].segments == places[id + PACKET].segments)) return;
    number = number_of(frame, rays, id);
    first = pixel_of(number, frame->window);
    found.first_ray = id;
    found.places = places;
    found.candidates = candidates;
    for (k = 0; k < PACKET; ++k) found.counts[k] = 0;
    if (first.inside) {
        const packet_slab_ray slabs = slabs_of(frame, rays_through(frame, first));
        const u32 within = rays_inside(frame, first), near_scene = bits_of(slabs.hits_sphere) & within;
        __global const BlockNode* next = list_of(frame, lists, number);
        for (k = 0; k < frame->unbounded_count; ++k) add_candidate(&found, k, within);
        for (; near_scene && next->node != NONE; ++next) add_subtree(&found, slabs, nodes, next->node, near_scene);
    }
    for (k = 0; !candidates && k < PACKET; ++k) {
        places[id + k].segments = found.counts[k];
        places[id + k].words = 0;
    }
}
