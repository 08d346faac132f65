// Edge: where a picture's surface ends or bends. Two neighbours in a line or a column have an edge between them if
// their regions differ, if their normals are more than 30 degrees apart, or if each lies two pixels' width or more off
// the other's tangent plane. The nearer of the two pixels is black, unless it is thin. All numbers are floats, as those
// of the picture are.
#ifndef CSGRT_SHADING_EDGE_H
#define CSGRT_SHADING_EDGE_H

#include "../shared/layout.h"

#define EDGE_COSINE 0.8660254f  // of 30 degrees, by which a surface may bend
#define EDGE_PIXELS 2           // by which a neighbour's point may lie off the tangent plane
#define EDGE_ROUNDING 0x1p-21f  // of distances
#define EDGE_WORD 0xff000000u   // black in CHANNEL_DISPLAY

#ifdef __OPENCL_VERSION__
// Roots and quotients of floats have a few wrong bits on some devices. In double they have enough right bits, so that
// the float is the right one.
FN float edge_root(float x) { return (float)sqrt((double)x); }
FN float edge_quotient(float a, float b) { return (float)((double)a / (double)b); }
FN float edge_abs(float x) { return fabs(x); }
#else
FN float edge_root(float x) { return host::root(x); }
FN float edge_quotient(float a, float b) { return a / b; }
FN float edge_abs(float x) { return host::abs(x); }
#endif

// The frame's camera. `left`, `top`: the first pixel of the screen, as Frame.first_x and first_y.
typedef struct {
    float u[3], down[3], w[3];
    float left, top;
    float slack;  // of the tangent plane, for s = 1
    u32 perspective;
} edge_camera;

FN edge_camera edge_camera_of(GLOBAL const Frame* f) {
    edge_camera c;
    u32 i;
    for (i = 0; i < 3; ++i) {
        c.u[i] = (float)f->u[i];
        c.down[i] = -(float)f->v[i];
        c.w[i] = (float)f->w[i];
    }
    c.left = (float)(f->first_x + (wide)f->screen.left);
    c.top = (float)(f->first_y - (wide)f->screen.top);
    c.slack = EDGE_PIXELS * edge_root(c.u[0] * c.u[0] + c.u[1] * c.u[1] + c.u[2] * c.u[2]);
    c.perspective = f->perspective;
    return c;
}

// What a pixel shows. Its point is eye + s D with the pixel's direction D, and in a parallel view base + s w. So from a
// pixel p to its neighbour q, whose direction is D + u or whose base is base + u, it is (s_q - s_p) D_p + m_q u, where
// m is s, and in a parallel view 1.
typedef struct {
    float distance, nx, ny, nz;
    u32 region;  // 0: nothing
    float s, m;
    float along, right, down;  // the normal's products with D, and with the way to the next pixel
} edge_pixel;

// The pixel in a column and a line of the screen, of whose values the first five members are set.
FN edge_pixel edge_pixel_at(edge_camera c, float column, float line, edge_pixel p) {
    const float x = c.perspective ? c.left + column : 0, y = c.perspective ? c.top - line : 0;
    const float dx = c.w[0] + x * c.u[0] - y * c.down[0], dy = c.w[1] + x * c.u[1] - y * c.down[1],
                dz = c.w[2] + x * c.u[2] - y * c.down[2];
    p.s = edge_quotient(p.distance, edge_root(dx * dx + dy * dy + dz * dz));
    p.m = c.perspective ? p.s : 1;
    p.along = p.nx * dx + p.ny * dy + p.nz * dz;
    p.right = p.nx * c.u[0] + p.ny * c.u[1] + p.nz * c.u[2];
    p.down = p.nx * c.down[0] + p.ny * c.down[1] + p.nz * c.down[2];
    return p;
}

// Which of two neighbours may be black, because there is an edge between them: 1 the first, 2 the second, 0 none.
// `a_side` and `b_side`: the products of their normals with the way from the first to the second.
FN u32 edge_between(edge_pixel a, float a_side, edge_pixel b, float b_side, float slack) {
    const float deeper = b.s - a.s;
    const float off_a = edge_abs(deeper * a.along + b.m * a_side), off_b = edge_abs(deeper * b.along + a.m * b_side);
    const float off = off_b < off_a ? off_b : off_a;
    const float allowed =
        slack * (a.m < b.m ? b.m : a.m) + EDGE_ROUNDING * (a.distance < b.distance ? b.distance : a.distance);
    const u32 is_seen = (a.region | b.region) != 0, differs = a.region != b.region;
    const u32 bends = a.nx * b.nx + a.ny * b.ny + a.nz * b.nz < EDGE_COSINE, jumps = allowed < off;
    const u32 is_edge = differs | (is_seen & (bends | jumps)), is_first = a.distance <= b.distance;
    return is_edge * (2u - is_first);
}

// Is a pixel thin in its line or column? Between the edges before and after it are at most two pixels: a part as narrow
// as this would be black from side to side. `before`, `after`: the pixel's edges. `next_after`, `last_before`: the next
// pixel's edge after it, and the last pixel's edge before it.
FN u32 edge_is_thin(u32 before, u32 after, u32 next_after, u32 last_before) {
    return (before && (after || next_after)) || (after && last_before);
}

#endif
