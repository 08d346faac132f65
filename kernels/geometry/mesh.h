// Closed surfaces of triangles: what they enclose by parity (see crossings.h), whichever way the triangles face.
// Parameters, words: see triangle.h. Surfaces: the triangles, and LEAVES where the ray goes out.
#ifndef CSGRT_MESH_H
#define CSGRT_MESH_H

#include "../shared/slab.h"
#include "crossings.h"
#include "triangle.h"

// All crossings count, those before t_min too: they tell whether the ray is inside there.
FN u32 mesh_collect(Geometry g, SolidRecord solid, u32 index, ray3 r, real t_min, GLOBAL End* ends) {
    crossings c = no_crossings(index, t_min, ends);
    GLOBAL const u32* mesh = g.words + solid.first_word;
    GLOBAL const real* vertices = g.reals + mesh[MESH_VERTICES];
    GLOBAL const BvhNode* nodes = g.inner_nodes + mesh[MESH_NODES];
    GLOBAL const u32* triangles = mesh + MESH_TRIANGLES;
    u32 node_count = mesh[MESH_NODE_COUNT], i = 0;
    upright_ray u = make_upright(to_local(g.reals + solid.first_real, r));
    slab_ray s;
    ray3 inner;
    inner.o = u.ray.o;
    inner.d = u.ray.d;
    s = make_slab_ray(inner, make_vec3(0, 0, 0), MESH_RADIUS, -REAL_INFINITY);
    if (!s.hits_sphere) return 0;
    while (i < node_count) {
        BvhNode node = nodes[i];
        if (!box_is_hit(s, node)) {
            i = node.skip;
        } else if (node.leaf) {
            u32 first = node.leaf >> BVH_LEAF_SHIFT, end = first + (node.leaf & BVH_LEAF_MASK);
            for (; first < end; ++first) {
                triangle_hit h = meet_triangle(u, vertices, triangles + 3 * (size_t)first);
                if (h.hit) c = cross(c, h.t, first);
            }
            i = node.skip;
        } else {
            ++i;
        }
    }
    return close_crossings(c);
}

// Against the ray where it goes in, along it where it goes out: the triangles may face either way.
FN vec3 mesh_normal(Geometry g, SolidRecord solid, ray3 r, u32 surface) {
    GLOBAL const real* p = g.reals + solid.first_real;
    GLOBAL const u32* mesh = g.words + solid.first_word;
    GLOBAL const u32* corners = mesh + MESH_TRIANGLES + 3 * (size_t)(surface & ~LEAVES);
    vec3 n = triangle_normal(g.reals + mesh[MESH_VERTICES], corners);
    int along = dot3(n, affine_linear(p, r.d)) > 0;
    n = affine_normal(p, n);
    return along == ((surface & LEAVES) != 0) ? n : scale(n, REAL(-1));
}

#endif
