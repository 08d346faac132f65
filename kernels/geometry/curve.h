// Plane curves: rational Bezier pieces, and the straight ones among them.
//
// A sketch stands in `words` from first_word on: where its reals begin, how many lines it has, how many curves, where
// in inner_nodes the hierarchy over its lines begins and how many nodes that has (0: none), then for each curve where
// its reals begin and its degree. The sketch's reals are x0 y0 x1 y1 a line. A curve's are x y weight a control point;
// weights are positive, and 1 at its ends. Points where pieces meet are equal to the bit. Pieces are numbered, lines
// first.
#ifndef CSGRT_GEOMETRY_CURVE_H
#define CSGRT_GEOMETRY_CURVE_H

#include "segments.h"

#define SKETCH_WORDS 5  // before the curves
#define CURVE_SIZE 13   // control points at most: degree 12 (Limits::curve_degree)

typedef struct {
    GLOBAL const real* lines;
    GLOBAL const u32* curves;
    GLOBAL const BvhNode* nodes;
    u32 line_count, curve_count, node_count;
} sketch;

FN sketch sketch_of(Geometry g, SolidRecord solid) {
    GLOBAL const u32* words = g.words + solid.first_word;
    sketch s;
    s.lines = g.reals + words[0];
    s.line_count = words[1];
    s.curve_count = words[2];
    s.nodes = g.inner_nodes + words[3];
    s.node_count = words[4];
    s.curves = words + SKETCH_WORDS;
    return s;
}

// A point and its rate of change, homogeneous: the point is (x / w, y / w).
typedef struct {
    real x, y, w;
    real dx, dy, dw;
} curve_point;

// At t by the last step of de Casteljau's algorithm, between the points of the curves of one degree less, each summed
// in the way of Horner (Farin). All terms have one sign where the coefficients do.
FN curve_point curve_at(GLOBAL const real* p, u32 degree, real t) {
    curve_point c;
    real s = REAL(1) - t, factor = 1, n = REAL(degree);
    real x0 = p[0] * p[2], y0 = p[1] * p[2], w0 = p[2];
    real x1 = p[3] * p[5], y1 = p[4] * p[5], w1 = p[5];
    real x = x1, y = y1, w = w1;  // of the point that both have, weighted
    u32 i;
    for (i = 1; i < degree; ++i) {
        factor = factor * (t * REAL(degree - i)) / REAL(i);
        x0 = real_fma(factor, x, x0 * s);
        y0 = real_fma(factor, y, y0 * s);
        w0 = real_fma(factor, w, w0 * s);
        p += 3;
        w = p[5];
        x = p[3] * w;
        y = p[4] * w;
        x1 = real_fma(factor, x, x1 * s);
        y1 = real_fma(factor, y, y1 * s);
        w1 = real_fma(factor, w, w1 * s);
    }
    c.x = real_fma(t, x1, s * x0);
    c.y = real_fma(t, y1, s * y0);
    c.w = real_fma(t, w1, s * w0);
    c.dx = n * (x1 - x0);
    c.dy = n * (y1 - y0);
    c.dw = n * (w1 - w0);
    return c;
}

#endif
