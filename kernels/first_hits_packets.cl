// The first hits of a picture on a processor: as first_hits.cl, but a work-item is a packet of eight rays.
#include "packet_pixels.h"

__kernel void first_hits(__global const Frame* frame, __global const SolidRecord* solids, __global const real* reals,
                         __global const PlaneRecord* planes, __global const PlaneRef* plane_refs, __global const u32* words,
                         __global const BvhNode* inner_nodes, __global const BvhNode* nodes,
                         __global const RegionRecord* regions, __global const StartRecord* starts, __global const u32* leaves,
                         __global const u32* trees, __global const MaterialRecord* materials,
                         __global const LightRecord* lights, __global const BlockNode* block_nodes,
                         __global const RayRecord* rays,
                         __global u32* overflows, __global u32* overflown, __global float* picture) {
    const u32 id = (u32)get_global_id(0) * PACKET;
    u32 number, which = 0, lost, hit, k;
    pixel_position at;
    packet_world_ray from_eye;
    scene_tables s;
    packet p;
    if (id >= frame->ray_count) return;
    number = number_of(frame, rays, id);
    at = pixel_of(number, frame->width, frame->height);
    if (!at.inside) return;
    for (k = 0; k < PACKET; ++k) {
        which |= at.x + k < frame->width ? 1u << k : 0;
        start_front(p.fronts + k);
        p.due[k] = BOX_MISSED;
    }
    from_eye = view_ray(frame, (double)at.x + (double8)(0, 1, 2, 3, 4, 5, 6, 7), (double8)((double)at.y));
    p.rays.o = from_eye.o;
    p.rays.d = from_eye.d;
    p.lanes = lanes_of(p.rays);
    p.t_min = frame->t_min;
    p.tolerance = frame->tolerance;
    p.offset = distance_of_center(frame);
    p.slabs = make_slab_ray(offset_from(packet_make_wide3(frame->center[0], frame->center[1], frame->center[2]), p.rays.o),
                            p.rays.d, frame->radius, frame->t_min);
    s.g = make_geometry(solids, reals, planes, plane_refs, words, inner_nodes);
    s.nodes = nodes;
    s.starts = starts;
    s.leaves = leaves;
    s.trees = trees;
    hit = first_hits_of(&p, frame, s, list_of(frame, block_nodes, number), which, &lost);
    put_pixels(&p, frame, s.g, regions, materials, lights, picture + id, which & ~lost, hit);
    for (; lost; lost &= lost - 1u) overflown[atomic_inc(overflows)] = number + lowest(lost);
}
