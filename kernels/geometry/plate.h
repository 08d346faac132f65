// Plate: triangles with thickness. Every triangle that the ray meets is a segment of its own; segments may overlap.
//
//            n |   / ray
//     ---------|--/---------  before / cos
//     triangle | x
//     ---------|/-----------  behind / cos          cos 1 if the thickness is measured along the ray
//
// Seen along the ray, a plate ends at an edge of the surface, or at an edge whose two triangles lie on the same side of
// it. A ray through such a line runs in the plane of the ray and the line, as in a flat face of a solid (beside.h).
//
// Parameters: affine (12), as in triangle.h, then SKIN: the thickness along the ray, in the world, of triangles that
// have none. Words: PLATE_*, then the mesh's. Surfaces as in mesh.h.
#ifndef CSGRT_GEOMETRY_PLATE_H
#define CSGRT_GEOMETRY_PLATE_H

#include "mesh.h"

#define PLATE_SKIN 12  // index of this parameter

#define PLATE_EXTENTS 0    // position in `reals`: before and behind for each triangle
#define PLATE_ALONG_RAY 1  // 1: measured along the ray
#define PLATE_ACROSS 2     // position in `words`: for each edge of each triangle its other triangle's corner, or NONE
#define PLATE_MESH 3

// The least cosine: at a smaller cosine the thickness along the ray has no meaning.
#define PLATE_FLATTEST BY_PRECISION(1e-5, 1e-9, 1e-9)

// The segment of a plate that the ray meets at w.t; empty if the ray is nearly parallel to the plate, or if the segment
// ends before t_min. A ray that grazes a plate has a long segment, far beyond the solid's box, as in BRL-CAD
// (Frame.whole_lines).
FN span plate_span(mesh_walk w, GLOBAL const u32* words, GLOBAL const real* extents, real skin, real t_min) {
    real before = extents[2 * (size_t)w.triangle], behind = extents[2 * (size_t)w.triangle + 1];
    real speed = real_sqrt(dot3(w.ray.ray.d, w.ray.ray.d));
    real rate = speed;
    span s;
    s.low = s.high = w.t;
    s.low_surface = s.high_surface = w.triangle;
    if (before == 0 && behind == 0) {
        s.high = w.t + skin;
        if (!(s.high >= t_min)) s.high = s.low;
        return s;
    }
    if (!words[PLATE_ALONG_RAY]) {
        vec3 n = triangle_normal(w.vertices, w.triangles + 3 * (size_t)w.triangle);
        rate = real_abs(dot3(n, w.ray.ray.d)) / real_sqrt(dot3(n, n));
    }
    if (!(rate > PLATE_FLATTEST * speed)) return s;
    s.low = w.t - before / rate;
    s.high = w.t + behind / rate;
    if (!(s.high >= t_min)) s.high = s.low;
    return s;
}

// Adds edge k of the triangle, from corner k to the next, if the ray meets it and plates end there, seen along the ray.
FN beside add_end_of_plates(beside b, mesh_walk w, u32 k, GLOBAL const u32* across, real rounding,
                            GLOBAL const real* place, ray3 r) {
    GLOBAL const u32* corners = w.triangles + 3 * (size_t)w.triangle;
    const u32 beyond = across[3 * (size_t)w.triangle + k];
    const vec3 from = upright_vertex(w.ray, w.vertices + 3 * (size_t)corners[k]);
    const vec3 to = upright_vertex(w.ray, w.vertices + 3 * (size_t)corners[(k + 1) % 3]);
    const vec3 own = upright_vertex(w.ray, w.vertices + 3 * (size_t)corners[(k + 2) % 3]);
    vec3 direction, any;
    if (!in_line(from, to, to, to, rounding, &direction) || in_line(from, to, own, own, rounding, &any)) return b;
    if (beyond != NONE) {
        const vec3 other = upright_vertex(w.ray, w.vertices + 3 * (size_t)beyond);
        const int own_side = difference_of_products(direction.x, own.y, direction.y, own.x) > 0;
        const int other_side = difference_of_products(direction.x, other.y, direction.y, other.x) > 0;
        if (own_side != other_side && !in_line(from, to, other, other, rounding, &any)) return b;
    }
    return add_local_face(b, normal_of_line(w.ray, direction), place, r);
}

// The planes through the ray and the lines at which plates end, if the ray meets these lines.
FN beside find_boundaries_of_plates(Geometry g, SolidRecord solid, ray3 r) {
    GLOBAL const u32* words = g.words + solid.first_word;
    GLOBAL const real* place = g.reals + solid.first_real;
    beside b = not_beside();
    mesh_walk w = next_in_box(start_mesh_walk(g, words + PLATE_MESH, place, r, b));
    const real rounding = seen_rounding(w.ray, place, r);
    u32 k;
    for (; w.triangle != NONE; w = next_in_box(w))
        for (k = 0; k < 3; ++k) b = add_end_of_plates(b, w, k, g.words + words[PLATE_ACROSS], rounding, place, r);
    return b;
}

FN u32 plate_collect(Geometry g, SolidRecord solid, ray3 r, crossings c, beside b, u32* near) {
    GLOBAL const u32* words = g.words + solid.first_word;
    GLOBAL const real* extents = g.reals + words[PLATE_EXTENTS];
    GLOBAL const real* place = g.reals + solid.first_real;
    mesh_walk w = start_mesh_walk(g, words + PLATE_MESH, place, r, b);
    real skin = place[PLATE_SKIN] / real_sqrt(dot3(r.d, r.d));
    u32 count = 0;
    for (;;) {
        span s;
        w = next_triangle(w);
        if (w.triangle == NONE) break;
        if (b.step) w.t = moved_back(w, b, place, r);
        s = plate_span(w, words, extents, skin, c.t_min);
        if (!(s.low < s.high)) continue;
        if (c.boundaries) {
            Boundary in, out;
            in.t = s.low;
            out.t = s.high;
            in.solid = out.solid = c.solid;
            in.surface = w.triangle | c.missed;
            out.surface = in.surface | LEAVES;
            insert_segment(c.boundaries, count, in, out);
        }
        ++count;
    }
    *near = w.near_edge;
    return count;
}

#endif
