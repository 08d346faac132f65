// Crossings: solids that a ray may cross any number of times (meshes, extrusions, ...) add their crossings here, in any
// order. Crossings are sorted in place, in the ray's own memory, and paired from the front: in, out, in, out.
//
//   crossings    |     |   |        |          of a closed surface: an even number
//   boundaries   in   out  in      out
//
// A surface that is not closed may leave one crossing over. This crossing becomes a segment of no length, which the
// weave drops. The triangles of some open surfaces face one way. Their crossings are marked in or out, and an in and
// the very next out are a pair:
//
//   crossings    |     |     |   |     |
//                out   in    in  out   out
//   segments                 |===|             the others are left over
#ifndef CSGRT_GEOMETRY_CROSSINGS_H
#define CSGRT_GEOMETRY_CROSSINGS_H

#include "segments.h"

#define LEAVES 0x80000000u  // set in Boundary.surface where the ray leaves a solid whose crossings were collected

// The crossings of a ray with one solid, collected in the memory of the solid's boundaries.
typedef struct {
    BOUNDARY_SPACE Boundary* boundaries;  // memory for the solid's boundaries; 0: they are only counted
    u32 solid;
    real t_min;         // segments that end before t_min are not wanted
    u32 behind, ahead;  // crossings before t_min, and the others
    real last;          // the distance of the last crossing before t_min
    u32 last_surface;
    u32 missed;  // set in the boundaries' surfaces: MISSED_...
} crossings;

FN crossings no_crossings(u32 solid, real t_min, BOUNDARY_SPACE Boundary* boundaries) {
    crossings c;
    c.boundaries = boundaries;
    c.solid = solid;
    c.t_min = t_min;
    c.behind = c.ahead = c.last_surface = c.missed = 0;
    c.last = 0;
    return c;
}

// Inserts a segment among `count` segments that are sorted by the distance and then the surface of their beginning.
FN void insert_segment(BOUNDARY_SPACE Boundary* boundaries, u32 count, Boundary in, Boundary out) {
    u32 i = count;
    while (i > 0 && (boundaries[2 * i - 2].t > in.t ||
                     (boundaries[2 * i - 2].t == in.t && boundaries[2 * i - 2].surface > in.surface))) {
        boundaries[2 * i] = boundaries[2 * i - 2];
        boundaries[2 * i + 1] = boundaries[2 * i - 1];
        --i;
    }
    boundaries[2 * i] = in;
    boundaries[2 * i + 1] = out;
}

// Adds a crossing. Crossings at one t are ordered by surface, so the order in which they are found does not matter.
FN crossings cross(crossings c, real t, u32 surface) {
    surface |= c.missed;
    if (t < c.t_min) {
        if (c.behind == 0 || t > c.last || (t == c.last && surface > c.last_surface)) {
            c.last = t;
            c.last_surface = surface;
        }
        ++c.behind;
        return c;
    }
    if (c.boundaries) {
        u32 i = c.ahead;
        Boundary e;
        while (i > 0 &&
               (c.boundaries[i - 1].t > t || (c.boundaries[i - 1].t == t && c.boundaries[i - 1].surface > surface))) {
            c.boundaries[i] = c.boundaries[i - 1];
            --i;
        }
        e.t = t;
        e.solid = c.solid;
        e.surface = surface;
        c.boundaries[i] = e;
    }
    ++c.ahead;
    return c;
}

// Pairs the crossings; returns the number of segments.
FN u32 close_crossings(crossings c) {
    u32 inside = c.behind & 1u;  // whether the ray is inside at t_min
    u32 count = c.ahead + inside, i;
    if (c.ahead == 0) return 0;
    if (c.boundaries) {
        if (inside) {
            Boundary e;
            for (i = c.ahead; i > 0; --i) c.boundaries[i] = c.boundaries[i - 1];
            e.t = c.last;
            e.solid = c.solid;
            e.surface = c.last_surface;
            c.boundaries[0] = e;
        }
        if (count & 1u) c.boundaries[count] = c.boundaries[count - 1];
        for (i = 1; i <= count; i += 2) c.boundaries[i].surface |= LEAVES;
    }
    return (count + 1) / 2;
}

// Pairs crossings that are already marked (LEAVES) where the ray goes out. Every out ends a segment, which has no
// length unless an in comes right before the out. More segments of no length may follow, because memory for all
// crossings was counted. Returns the number of segments.
FN u32 close_marked_crossings(crossings c, u32 outs) {
    u32 inside = c.behind > 0 && !(c.last_surface & LEAVES);  // whether the ray is inside at t_min
    u32 count = (c.ahead + 1) / 2, kept = 0, out = outs, i;
    if (count < outs) count = outs;
    if (!c.boundaries || count == 0) return count;
    // Keeps the outs, and the ins that are right before an out.
    for (i = 0; i < c.ahead; ++i)
        if ((c.boundaries[i].surface & LEAVES) || (i + 1 < c.ahead && (c.boundaries[i + 1].surface & LEAVES))) {
            Boundary e = c.boundaries[i];
            c.boundaries[kept++] = e;
        }
    // The loop runs from the back, because pairs take more memory.
    {
        Boundary last = c.boundaries[kept > 0 ? kept - 1 : 0];
        for (i = outs; i < count; ++i) {
            c.boundaries[2 * i] = last;
            c.boundaries[2 * i + 1] = last;
        }
    }
    while (out > 0) {
        Boundary e = c.boundaries[--kept], in = e;
        --out;
        if (kept > 0) {
            if (!(c.boundaries[kept - 1].surface & LEAVES)) in = c.boundaries[--kept];
        } else if (inside) {
            in.t = c.last;
            in.surface = c.last_surface;
        }
        c.boundaries[2 * out] = in;
        c.boundaries[2 * out + 1] = e;
    }
    return count;
}

#endif
