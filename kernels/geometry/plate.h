// Triangles with thickness: every one that the ray meets is a segment of its own; they may overlap.
//
//            n |   / ray
//     ---------|--/---------  before / cos
//     triangle | x
//     ---------|/-----------  behind / cos          cos 1 if the thickness is measured along the ray
//
// Parameters: those of the place, as triangle.h has them, then SKIN: how thick along the ray, in the world, triangles
// without thickness are. Words: PLATE_*, then the mesh's. Surfaces as in mesh.h.
#ifndef CSGRT_PLATE_H
#define CSGRT_PLATE_H

#include "mesh.h"

#define PLATE_SKIN 12  // among the parameters

#define PLATE_EXTENTS 0    // where in `reals`: before and behind for each triangle; the box's corners stand before them
#define PLATE_ALONG_RAY 1  // 1: measured along the ray
#define PLATE_MESH 2
#define PLATE_BOX 6

// Nothing that is met at a smaller cosine has a thickness that makes sense.
#define PLATE_FLATTEST REAL(1e-9)

// The piece of the ray within a box, in its own parameter. Rays come here that do meet it, but for roundings.
FN span box_span(local_ray l, GLOBAL const real* box) {
    span s = whole_line();
    int axis;
    for (axis = 0; axis < 3; ++axis) {
        real d = turned(l.d, axis).z, o = turned(l.o, axis).z;
        real low = (box[axis] - o) / d, high = (box[3 + axis] - o) / d;
        if (d == 0) continue;
        s.low = real_max(s.low, real_min(low, high));
        s.high = real_min(s.high, real_max(low, high));
    }
    s.low = l.shift + s.low;
    s.high = l.shift + s.high;
    return s;
}

// Where a plate begins and ends that is met at w.t. Empty: it is not wanted. No plate reaches beyond the box around them
// all, which it otherwise would where the ray grazes it.
FN span plate_span(mesh_walk w, GLOBAL const u32* words, GLOBAL const real* extents, span box, real skin, real t_min) {
    real before = extents[2 * (size_t)w.triangle], behind = extents[2 * (size_t)w.triangle + 1];
    real speed = real_sqrt(dot3(w.ray.ray.d, w.ray.ray.d));
    real rate = speed;
    span s;
    s.low = s.high = w.t;
    s.low_surface = s.high_surface = w.triangle;
    if (before == 0 && behind == 0) {
        if (w.t >= t_min) s.high = w.t + skin;
        return s;
    }
    if (!words[PLATE_ALONG_RAY]) {
        vec3 n = triangle_normal(w.vertices, w.triangles + 3 * (size_t)w.triangle);
        rate = real_abs(dot3(n, w.ray.ray.d)) / real_sqrt(dot3(n, n));
    }
    if (!(rate > PLATE_FLATTEST * speed)) return s;
    s.low = real_min(w.t, real_max(w.t - before / rate, box.low));
    s.high = real_max(w.t, real_min(w.t + behind / rate, box.high));
    if (!(s.high >= t_min)) s.high = s.low;
    return s;
}

FN u32 plate_collect(Geometry g, SolidRecord solid, u32 index, ray3 r, real t_min, GLOBAL End* ends) {
    GLOBAL const u32* words = g.words + solid.first_word;
    GLOBAL const real* extents = g.reals + words[PLATE_EXTENTS];
    GLOBAL const real* place = g.reals + solid.first_real;
    mesh_walk w = start_mesh_walk(g, words + PLATE_MESH, place, r);
    span box = box_span(w.ray.ray, extents - PLATE_BOX);
    real skin = place[PLATE_SKIN] / real_sqrt(dot3(r.d, r.d));
    u32 count = 0;
    for (;;) {
        span s;
        w = next_triangle(w);
        if (w.triangle == NONE) break;
        s = plate_span(w, words, extents, box, skin, t_min);
        if (!(s.low < s.high)) continue;
        if (ends) {
            u32 i = count;
            End e;
            while (i > 0 && (ends[2 * i - 2].t > s.low || (ends[2 * i - 2].t == s.low && ends[2 * i - 2].surface > w.triangle))) {
                ends[2 * i] = ends[2 * i - 2];
                ends[2 * i + 1] = ends[2 * i - 1];
                --i;
            }
            e.t = s.low;
            e.solid = index;
            e.surface = w.triangle;
            ends[2 * i] = e;
            e.t = s.high;
            e.surface = w.triangle | LEAVES;
            ends[2 * i + 1] = e;
        }
        ++count;
    }
    return count;
}

#endif
