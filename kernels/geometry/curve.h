// Curves: plane rational Bezier curves, and straight lines.
//
// A sketch is stored in `words` from first_word on: the position of its reals, the number of lines, the number of
// curves, the position in inner_nodes of the hierarchy over the lines, and the number of the hierarchy's nodes (0:
// none). Then come for each curve the position of its reals and its degree. The sketch's reals are x0 y0 x1 y1 a line.
// A curve's reals are x y weight a control point; weights are positive, and 1 at the first and last. Points where lines
// and curves meet are equal to the bit. Lines and curves are numbered together, lines first.
#ifndef CSGRT_GEOMETRY_CURVE_H
#define CSGRT_GEOMETRY_CURVE_H

#include "segments.h"

#define SKETCH_WORDS 5  // before the curves
#define CURVE_SIZE 13   // control points at most: degree 12 (Limits::curve_degree)

// A sketch in the scene's tables.
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

// A point and its rate of change in homogeneous coordinates: the point is (x / w, y / w).
typedef struct {
    real x, y, w;
    real dx, dy, dw;
} curve_point;

// The point at t, by the last step of de Casteljau's algorithm, between the points of two curves of one degree less.
// Each of these two points is summed as in Horner's rule (Farin). If all coefficients have one sign, so have all terms.
FN curve_point curve_at(GLOBAL const real* p, u32 degree, real t) {
    curve_point c;
    real s = REAL(1) - t, factor = 1, n = REAL(degree);
    real x0 = p[0] * p[2], y0 = p[1] * p[2], w0 = p[2];
    real x1 = p[3] * p[5], y1 = p[4] * p[5], w1 = p[5];
    real x = x1, y = y1, w = w1;  // the control point that the two curves share, weighted
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
