// Collect: finds any solid's segments along a ray, as boundaries. The kernels, the reference and the tests use it.
#ifndef CSGRT_GEOMETRY_COLLECT_H
#define CSGRT_GEOMETRY_COLLECT_H

#include "crossings.h"
#include "extrude.h"
#include "mesh.h"
#include "plate.h"
#include "revolve.h"
#include "solid.h"
#include "touch.h"

// A function that is not inlined into a WHOLE_FN: its work takes much longer than its call.
#ifndef PART_FN
#define PART_FN FN
#endif

FN void put_segment(BOUNDARY_SPACE Boundary* boundaries, u32 solid, real in, u32 in_surface, real out,
                    u32 out_surface) {
    Boundary e;
    e.solid = solid;
    e.t = in;
    e.surface = in_surface;
    boundaries[0] = e;
    e.t = out;
    e.surface = out_surface;
    boundaries[1] = e;
}

#if (CSGRT_SOLIDS) & FLAT_FACED
// The segments of a FLAT_FACED solid for the ray as it is, or moved aside of faces by `b`. *near: the ray may run in a
// face.
FN u32 collect_once(Geometry g, SolidRecord solid, ray3 r, crossings c, beside b, u32* near) {
#if HAS_SOLID(SOLID_EXTRUDE)
    if (solid.type == SOLID_EXTRUDE) return close_crossings(extrude_cross(g, solid, r, c, b, near));
#endif
#if HAS_SOLID(SOLID_REVOLVE)
    if (solid.type == SOLID_REVOLVE) return close_crossings(revolve_cross(g, solid, r, c, b, near));
#endif
#if HAS_SOLID(SOLID_MESH)
    if (solid.type == SOLID_MESH) return mesh_collect(g, solid, r, c, b, near);
#endif
#if HAS_SOLID(SOLID_PLATE)
    if (solid.type == SOLID_PLATE) return plate_collect(g, solid, r, c, b, near);
#endif
    return 0;
}

// The faces in which the ray runs.
FN beside find_faces(Geometry g, SolidRecord solid, ray3 r) {
#if HAS_SOLID(SOLID_EXTRUDE)
    if (solid.type == SOLID_EXTRUDE) return find_walls(g, solid, r);
#endif
#if HAS_SOLID(SOLID_REVOLVE)
    if (solid.type == SOLID_REVOLVE) return find_flat_lines(g, solid, r);
#endif
#if HAS_SOLID(SOLID_MESH)
    if (solid.type == SOLID_MESH) return find_triangles(g, solid, r);
#endif
#if HAS_SOLID(SOLID_PLATE)
    if (solid.type == SOLID_PLATE) return find_boundaries_of_plates(g, solid, r);
#endif
    return not_beside();
}

// The segments of every step aside, if the ray runs in a face of the solid. These segments may overlap. `stored`: the
// number of segments of the unmoved ray, whose memory the new segments take. `r` is the world's ray. The function is
// not inlined, because inlined rare code slows down every ray.
NOINLINE_FN u32 collect_beside(Geometry g, SolidRecord solid, u32 index, ray3 r, real t_min,
                               BOUNDARY_SPACE Boundary* boundaries, u32 stored) {
    beside b;
    u32 count = 0, near = 0;
    r = ray_at(solid, r);
    b = find_faces(g, solid, r);
    if (!b.found) return stored;
    while (next_step(&b)) {
        crossings c = no_crossings(index, t_min, boundaries ? boundaries + 2 * (size_t)count : boundaries);
        u32 found, i;
        c.missed = missed_beside(b);
        found = collect_once(g, solid, r, c, b, &near);
        if (boundaries && count > 0) {
            for (i = 0; i < found; ++i) {
                const Boundary in = boundaries[2 * (count + i)], out = boundaries[2 * (count + i) + 1];
                insert_segment(boundaries, count + i, in, out);
            }
        }
        count += found;
    }
    // The unmoved ray's segments were counted before it was known that the ray runs in a face, so the result has at
    // least as many.
    for (; count < stored; ++count)
        if (boundaries) {
            boundaries[2 * (size_t)count].surface |= MISSED;
            boundaries[2 * (size_t)count + 1] = boundaries[2 * (size_t)count];
        }
    return count;
}
#endif

// Collects from solids of types that may have more than two segments. Returns 0 for other types; else sets *count. See
// collect_as_it_is(). `r` is the solid's own ray (ray_at).
PART_FN u32 collect_many(Geometry g, SolidRecord solid, u32 index, ray3 r, real t_min,
                         BOUNDARY_SPACE Boundary* boundaries, u32* count, u32* near) {
#if (CSGRT_SOLIDS) & FLAT_FACED
    if (FLAT_FACED >> solid.type & 1u) {
        *count = collect_once(g, solid, r, no_crossings(index, t_min, boundaries), not_beside(), near);
        return 1;
    }
#endif
#if HAS_SOLID(SOLID_SUPERELL)
    if (solid.type == SOLID_SUPERELL) {
        *count = close_crossings(superell_cross(g.reals + solid.first_real, r, no_crossings(index, t_min, boundaries)));
        return 1;
    }
#endif
#if HAS_SOLID(SOLID_HRT)
    if (solid.type == SOLID_HRT) {
        *count = close_crossings(hrt_cross(g.reals + solid.first_real, r, no_crossings(index, t_min, boundaries)));
        return 1;
    }
#endif
#if HAS_SOLID(SOLID_METABALL)
    if (solid.type == SOLID_METABALL) {
        *count = close_crossings(metaball_cross(g, solid, r, no_crossings(index, t_min, boundaries)));
        return 1;
    }
#endif
    return 0;
}

// The segments, of a solid of any other type, that end at t_min or later.
FN segments collect_few(Geometry g, SolidRecord solid, ray3 r, real t_min) {
    segments h = intersect(g, solid, r);
    if (h.touched) h = mark_touched(g, solid, r, h);
    if (h.count > 1 && !(h.out1 >= t_min)) h.count = 1;
    if (h.count > 0 && !(h.out0 >= t_min)) {
        --h.count;
        h.in0 = h.in1;
        h.in0_surface = h.in1_surface;
        h.out0 = h.out1;
        h.out0_surface = h.out1_surface;
    }
    return h;
}

// Collects the segments of the ray as it is. *near becomes 1 if the ray may run in faces of the solid: then the caller
// needs collect_beside(), too.
WHOLE_FN u32 collect_as_it_is(Geometry g, SolidRecord solid, u32 index, ray3 r, real t_min,
                              BOUNDARY_SPACE Boundary* boundaries, u32* near) {
    const ray3 own = ray_at(solid, r);
    segments h;
    u32 count;
    if (collect_many(g, solid, index, own, t_min, boundaries, &count, near)) return count;
    h = collect_few(g, solid, own, t_min);
    if (boundaries && h.count > 0) put_segment(boundaries, index, h.in0, h.in0_surface, h.out0, h.out0_surface);
    if (boundaries && h.count > 1) put_segment(boundaries + 2, index, h.in1, h.in1_surface, h.out1, h.out1_surface);
    return h.count;
}

// Returns how many segments of the solid end at t_min or later. Their boundaries are stored from `boundaries` on,
// unless `boundaries` is 0: two a segment, in then out, by ascending distance. `index`: the solid's number.
WHOLE_FN u32 collect(Geometry g, SolidRecord solid, u32 index, ray3 r, real t_min,
                     BOUNDARY_SPACE Boundary* boundaries) {
    u32 near = 0;
    const u32 count = collect_as_it_is(g, solid, index, r, t_min, boundaries, &near);
#if (CSGRT_SOLIDS) & FLAT_FACED
    if (near) return collect_beside(g, solid, index, r, t_min, boundaries, count);
#endif
    return count;
}

#endif
