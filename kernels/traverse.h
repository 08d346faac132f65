// The walk through the bounding volume hierarchy that kernels 1 (count hits) and 2 (store segments) share: the same
// rays meet the same solids in the same order, so what was counted is what is stored.
//
// Nodes stand in depth-first order and know where to go on when their box is missed: no stack. Solids are numbered in
// the order of the leaves, so a ray's segments come out sorted by solid. Every hit along the ray is wanted, so the order
// of distance does not matter here.
//
// The slab test runs in float. It may enter a box that the ray misses, never the reverse: the origin is moved to the
// ray's closest approach to the model's center, so |p| <= radius; then the errors of p, 1/d and the products amount to
// less than radius * 2^-21 of displacement an axis, and boxes are padded by radius * 2^-20 when they are built.
#ifndef CSGRT_TRAVERSE_H
#define CSGRT_TRAVERSE_H

#include "geometry/solid.h"

typedef struct {
    float px, py, pz;  // a point of the ray, relative to Frame.center
    float ix, iy, iz;  // 1 / direction
    float t_min;       // in the hierarchy's own parameter
    int hits_sphere;   // 0: no bounded solid can be hit
} slab_ray;

FN slab_ray make_slab_ray(GLOBAL const Frame* f, ray3 r) {
    slab_ray s;
    vec3 o = subtract(r.o, make_vec3(f->center[0], f->center[1], f->center[2]));
    real length = real_sqrt(dot3(r.d, r.d));
    vec3 d = scale(r.d, REAL(1) / length);
    real shift = -dot3(o, d);
    vec3 p = add_scaled(o, shift, d);
    real reach = f->radius * REAL(1.0000001);
    s.hits_sphere = dot3(p, p) <= reach * reach;
    s.px = (float)p.x;
    s.py = (float)p.y;
    s.pz = (float)p.z;
    s.ix = 1.0f / (float)d.x;
    s.iy = 1.0f / (float)d.y;
    s.iz = 1.0f / (float)d.z;
    // Segments that end before t_min are not wanted; radius * 2^-20 covers the rounding to float.
    s.t_min = (float)(real_max(f->t_min * length - shift, REAL(-4) * f->radius) - f->radius * REAL(0x1p-20));
    return s;
}

// fmin and fmax pass a NaN by: 0 * infinity arises only for a ray within a padded face's plane, outside the true box.
FN int box_is_hit(slab_ray s, BvhNode node) {
    float x0 = (node.low[0] - s.px) * s.ix, x1 = (node.high[0] - s.px) * s.ix;
    float y0 = (node.low[1] - s.py) * s.iy, y1 = (node.high[1] - s.py) * s.iy;
    float z0 = (node.low[2] - s.pz) * s.iz, z1 = (node.high[2] - s.pz) * s.iz;
    float in = fmax(fmax(fmin(x0, x1), fmin(y0, y1)), fmax(fmin(z0, z1), s.t_min));
    float out = fmin(fmin(fmax(x0, x1), fmax(y0, y1)), fmax(z0, z1));
    return in <= out;
}

FN GLOBAL End* put_end(GLOBAL End* at, real t, u32 solid, u32 surface) {
    End e;
    e.t = t;
    e.solid = solid;
    e.surface = surface;
    *at = e;
    return at + 1;
}

// What the walk hands on: counts, and where the next end goes (ends == 0: count only).
typedef struct {
    u32 segments;
    u32 regions;
    GLOBAL End* ends;
} walk_state;

FN walk_state meet_solid(GLOBAL const Frame* f, Geometry g, u32 index, ray3 r, walk_state w) {
    SolidRecord solid = g.solids[index];
    hits h = intersect(g, solid, r);
    u32 wanted = 0;
    if (h.count > 0 && h.out0 >= f->t_min) {
        ++wanted;
        if (w.ends) {
            w.ends = put_end(w.ends, h.in0, index, h.in0_surface);
            w.ends = put_end(w.ends, h.out0, index, h.out0_surface);
        }
    }
    if (h.count > 1 && h.out1 >= f->t_min) {
        ++wanted;
        if (w.ends) {
            w.ends = put_end(w.ends, h.in1, index, h.in1_surface);
            w.ends = put_end(w.ends, h.out1, index, h.out1_surface);
        }
    }
    if (wanted) {
        w.segments += wanted;
        w.regions += solid.region_count;
    }
    return w;
}

FN walk_state walk(GLOBAL const Frame* f, Geometry g, GLOBAL const BvhNode* nodes, ray3 r, GLOBAL End* ends) {
    walk_state w;
    slab_ray s = make_slab_ray(f, r);
    u32 i;
    w.segments = 0;
    w.regions = 0;
    w.ends = ends;
    for (i = 0; i < f->unbounded_count; ++i) w = meet_solid(f, g, i, r, w);
    if (!s.hits_sphere) return w;
    i = 0;
    while (i < f->node_count) {
        BvhNode node = nodes[i];
        if (!box_is_hit(s, node)) {
            i = node.skip;
        } else if (node.leaf) {
            u32 first = node.leaf >> BVH_LEAF_SHIFT, end = first + (node.leaf & BVH_LEAF_MASK);
            for (; first < end; ++first) w = meet_solid(f, g, first, r, w);
            i = node.skip;
        } else {
            ++i;
        }
    }
    return w;
}

#endif
