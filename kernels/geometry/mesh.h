// Mesh: surfaces of triangles. A closed surface encloses its inside by parity (see crossings.h), however its triangles
// are oriented. An open surface whose triangles face one way has an inside for rays that do not pass through a gap.
// Parameters, words: see triangle.h. Surfaces: the triangles, and LEAVES where the ray goes out.
#ifndef CSGRT_GEOMETRY_MESH_H
#define CSGRT_GEOMETRY_MESH_H

#include "../traversal/bvh_cursor.h"
#include "crossings.h"
#include "triangle.h"

// The triangles that a ray meets, one after the other in the order of the hierarchy. Triangles before t_min count, too:
// their number tells whether the ray is inside at t_min.
typedef struct {
    GLOBAL const real* vertices;
    GLOBAL const BvhNode* nodes;
    GLOBAL const u32* triangles;
    upright_ray ray;
    real edge_on;  // an edge whose two points have a smaller product may lie in one plane with the ray
    slab_ray slab;
    bvh_cursor cursor;
    u32 next, last;  // triangles of the leaf that are left
    u32 triangle;    // the triangle that the ray meets; NONE: there is none
    real t;          // the distance of the hit
    int clockwise;   // the turn of the triangle's corners, seen along the ray
    u32 near_face;   // the ray has come near a triangle that is seen edge-on
    u32 near_edge;   // the ray has come near a line through two corners
} mesh_walk;

// The limit below which the product of an edge's two points counts as 0, per rounding of a point's position: the points
// lie within twice MESH_RADIUS of 0.
#define EDGE_ON (REAL(8) * MESH_RADIUS)

FN mesh_walk start_mesh_walk(Geometry g, GLOBAL const u32* mesh, GLOBAL const real* place, ray3 r, beside b) {
    mesh_walk w;
    w.vertices = g.reals + mesh[MESH_VERTICES];
    w.nodes = g.inner_nodes + mesh[MESH_NODES];
    w.triangles = mesh + MESH_TRIANGLES;
    w.ray = make_upright(moved_aside(to_local(place, r), b, place, r));
    w.edge_on = EDGE_ON * seen_rounding(w.ray, place, r);
    w.slab = make_slab_ray(offset_from(widen(make_vec3(0, 0, 0)), widen(w.ray.ray.o)), w.ray.ray.d, MESH_RADIUS,
                           -REAL_INFINITY);
    w.cursor = bvh_over(w.slab.hits_sphere ? mesh[MESH_NODE_COUNT] : 0);
    w.next = w.last = 0;
    w.triangle = NONE;
    w.t = 0;
    w.clockwise = 0;
    w.near_face = w.near_edge = 0;
    return w;
}

FN mesh_walk next_triangle(mesh_walk w) {
    w.triangle = NONE;
    for (;;) {
        u32 leaf;
        while (w.next < w.last) {
            triangle_hit h = meet_triangle(w.ray, w.edge_on, w.vertices, w.triangles + 3 * (size_t)w.next);
            ++w.next;
            w.near_face |= (u32)h.edge_on;
            w.near_edge |= (u32)h.edge;
            if (h.hit) {
                w.triangle = w.next - 1;
                w.t = h.t;
                w.clockwise = h.clockwise;
                return w;
            }
        }
        leaf = next_leaf(w.slab, w.nodes, &w.cursor);
        if (!leaf) return w;
        w.next = leaf >> BVH_LEAF_SHIFT;
        w.last = w.next + (leaf & BVH_LEAF_MASK);
    }
}

// Moves to the next triangle of the boxes that the ray meets, whether it meets the triangle or not; NONE: there is
// none.
FN mesh_walk next_in_box(mesh_walk w) {
    if (w.next == w.last) {
        const u32 leaf = next_leaf(w.slab, w.nodes, &w.cursor);
        w.next = leaf >> BVH_LEAF_SHIFT;
        w.last = w.next + (leaf & BVH_LEAF_MASK);
    }
    w.triangle = w.next < w.last ? w.next++ : NONE;
    return w;
}

// The planes of triangles in which the ray runs.
FN beside find_triangles(Geometry g, SolidRecord solid, ray3 r) {
    GLOBAL const real* place = g.reals + solid.first_real;
    beside b = not_beside();
    mesh_walk w = next_in_box(start_mesh_walk(g, g.words + solid.first_word, place, r, b));
    for (; w.triangle != NONE; w = next_in_box(w))
        b = add_triangle(b, w.ray, w.vertices, w.triangles + 3 * (size_t)w.triangle, place, r);
    return b;
}

// The square of a cosine. moved_back() leaves hits of triangles with a smaller cosine alone: the correction would move
// such a hit off the triangle, and the step aside has moved it less.
#define SLIDES REAL(0x1p-14)

// The distance where the unmoved ray meets the plane of a triangle that it meets aside of a face.
RARE_FN real moved_back(mesh_walk w, beside b, GLOBAL const real* place, ray3 r) {
    const vec3 n = triangle_normal(w.vertices, w.triangles + 3 * (size_t)w.triangle);
    const vec3 d = w.ray.ray.d;
    const real rate = dot3(n, d);
    if (!(rate * rate > SLIDES * dot3(n, n) * dot3(d, d))) return w.t;
    return w.t + dot3(n, aside(b, place, r)) / rate;
}

WHOLE_FN u32 mesh_collect(Geometry g, SolidRecord solid, ray3 r, crossings c, beside b, u32* near) {
    GLOBAL const u32* mesh = g.words + solid.first_word;
    GLOBAL const real* place = g.reals + solid.first_real;
    u32 facing = mesh[MESH_FACING], outs = 0;
    mesh_walk w = start_mesh_walk(g, mesh, place, r, b);
    for (;;) {
        int leaves;
        w = next_triangle(w);
        if (w.triangle == NONE) break;
        if (b.step) w.t = moved_back(w, b, place, r);
        // A triangle whose corners turn counterclockwise from outside is clockwise from within, for a ray on its way
        // out.
        leaves = facing != 0 && (w.clockwise != 0) == (facing == 1);
        if (leaves && w.t >= c.t_min) ++outs;
        c = cross(c, w.t, leaves ? w.triangle | LEAVES : w.triangle);
    }
    *near = w.near_face;
    return facing ? close_marked_crossings(c, outs) : close_crossings(c);
}

// The normal of a triangle: against the ray where the ray goes in, along the ray where it goes out. The triangles may
// have any orientation.
FN vec3 mesh_normal(Geometry g, GLOBAL const u32* mesh, GLOBAL const real* place, ray3 r, u32 surface) {
    GLOBAL const u32* corners = mesh + MESH_TRIANGLES + 3 * (size_t)(surface & ~LEAVES);
    vec3 n = triangle_normal(g.reals + mesh[MESH_VERTICES], corners);
    int along = dot3(n, affine_linear(place, r.d)) > 0;
    n = affine_normal(place, n);
    return along == ((surface & LEAVES) != 0) ? n : scale(n, REAL(-1));
}

#endif
