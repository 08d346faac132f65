// Crossings: solids that a ray may cross any number of times (meshes, extrusions, ...) add their crossings here, in any
// order. Crossings are sorted in place, in the ray's own memory, and paired from the front: in, out, in, out.
//
//   crossings    |     |   |        |          of a closed surface: an even number
//   boundaries   in   out  in      out
//
// A surface that is not closed leaves one crossing over: it becomes a segment of no length, which the weave drops. Some
// open surfaces tell their inside from their outside. Their crossings are marked in or out, and an in and the very next
// out are a pair:
//
//   crossings    |     |     |   |     |
//                out   in    in  out   out
//   segments                 |===|             the others are left over
#ifndef CSGRT_GEOMETRY_CROSSINGS_H
#define CSGRT_GEOMETRY_CROSSINGS_H

#include "segments.h"

#define LEAVES 0x80000000u  // set in End.surface of a boundary where the ray leaves such a solid

typedef struct {
    ENDS End* ends;  // memory for the solid's boundaries; 0: they are only counted
    u32 solid;
    real t_min;         // segments that end before this are not wanted
    u32 behind, ahead;  // crossings before t_min, and the others
    real last;          // the distance of the last crossing before t_min
    u32 last_surface;
    u32 missed;  // set in the boundaries' surfaces: MISSED_...
} crossings;

FN crossings no_crossings(u32 solid, real t_min, ENDS End* ends) {
    crossings c;
    c.ends = ends;
    c.solid = solid;
    c.t_min = t_min;
    c.behind = c.ahead = c.last_surface = c.missed = 0;
    c.last = 0;
    return c;
}

// Inserts a segment among `count` segments that are sorted by the distance and then the surface of their beginning.
FN void insert_segment(ENDS End* ends, u32 count, End in, End out) {
    u32 i = count;
    while (i > 0 && (ends[2 * i - 2].t > in.t || (ends[2 * i - 2].t == in.t && ends[2 * i - 2].surface > in.surface))) {
        ends[2 * i] = ends[2 * i - 2];
        ends[2 * i + 1] = ends[2 * i - 1];
        --i;
    }
    ends[2 * i] = in;
    ends[2 * i + 1] = out;
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
    if (c.ends) {
        u32 i = c.ahead;
        End e;
        while (i > 0 && (c.ends[i - 1].t > t || (c.ends[i - 1].t == t && c.ends[i - 1].surface > surface))) {
            c.ends[i] = c.ends[i - 1];
            --i;
        }
        e.t = t;
        e.solid = c.solid;
        e.surface = surface;
        c.ends[i] = e;
    }
    ++c.ahead;
    return c;
}

// Pairs the crossings; returns the number of segments.
FN u32 close_crossings(crossings c) {
    u32 inside = c.behind & 1u;  // whether the ray is inside at t_min
    u32 count = c.ahead + inside, i;
    if (c.ahead == 0) return 0;
    if (c.ends) {
        if (inside) {
            End e;
            for (i = c.ahead; i > 0; --i) c.ends[i] = c.ends[i - 1];
            e.t = c.last;
            e.solid = c.solid;
            e.surface = c.last_surface;
            c.ends[0] = e;
        }
        if (count & 1u) c.ends[count] = c.ends[count - 1];
        for (i = 1; i <= count; i += 2) c.ends[i].surface |= LEAVES;
    }
    return (count + 1) / 2;
}

// Pairs crossings that are already marked (LEAVES) where the ray goes out. Every out ends a segment, which has no
// length unless an in came right before it. More segments of no length may follow, because room for all crossings was
// counted. Returns the number of segments.
FN u32 close_marked_crossings(crossings c, u32 outs) {
    u32 inside = c.behind > 0 && !(c.last_surface & LEAVES);  // whether the ray is inside at t_min
    u32 count = (c.ahead + 1) / 2, kept = 0, out = outs, i;
    if (count < outs) count = outs;
    if (!c.ends || count == 0) return count;
    // The crossings that stay: the outs, and ins before an out.
    for (i = 0; i < c.ahead; ++i)
        if ((c.ends[i].surface & LEAVES) || (i + 1 < c.ahead && (c.ends[i + 1].surface & LEAVES))) {
            End e = c.ends[i];
            c.ends[kept++] = e;
        }
    // The loop runs from the back, because pairs take more room.
    {
        End last = c.ends[kept > 0 ? kept - 1 : 0];
        for (i = outs; i < count; ++i) {
            c.ends[2 * i] = last;
            c.ends[2 * i + 1] = last;
        }
    }
    while (out > 0) {
        End e = c.ends[--kept], in = e;
        --out;
        if (kept > 0) {
            if (!(c.ends[kept - 1].surface & LEAVES)) in = c.ends[--kept];
        } else if (inside) {
            in.t = c.last;
            in.surface = c.last_surface;
        }
        c.ends[2 * out] = in;
        c.ends[2 * out + 1] = e;
    }
    return count;
}

#endif
