// Rays against boxes of a bounding volume hierarchy, in float.
//
// The slab test may enter a box that the ray misses, never the reverse: the origin is moved to the ray's closest approach
// to the hierarchy's center, so |p| <= radius; then the errors of p, 1/d and the products amount to less than
// radius * 2^-21 of displacement an axis, and boxes are padded by radius * 2^-20 when they are built.
#ifndef CSGRT_SLAB_H
#define CSGRT_SLAB_H

#include "layout.h"

typedef struct {
    float px, py, pz;  // a point of the ray, relative to the center
    float ix, iy, iz;  // 1 / direction
    float t_min;       // in the hierarchy's own parameter
    int hits_sphere;   // 0: nothing can be hit
} slab_ray;

// All boxes lie within `radius` of `center`. What ends before t_min is not wanted.
FN slab_ray make_slab_ray(ray3 r, vec3 center, real radius, real t_min) {
    slab_ray s;
    vec3 o = subtract(r.o, center);
    real length = real_sqrt(dot3(r.d, r.d));
    vec3 d = scale(r.d, REAL(1) / length);
    real shift = -dot3(o, d);
    vec3 p = add_scaled(o, shift, d);
    real reach = radius * REAL(1.0000001);
    s.hits_sphere = dot3(p, p) <= reach * reach;
    s.px = (float)p.x;
    s.py = (float)p.y;
    s.pz = (float)p.z;
    s.ix = 1.0f / (float)d.x;
    s.iy = 1.0f / (float)d.y;
    s.iz = 1.0f / (float)d.z;
    // Segments that end before t_min are not wanted; radius * 2^-20 covers the rounding to float.
    s.t_min = (float)(real_max(t_min * length - shift, REAL(-4) * radius) - radius * REAL(0x1p-20));
    return s;
}

// fmin and fmax pass a NaN by: 0 * infinity arises only for a ray within a padded face's plane, outside the true box.
FN int box_is_hit(slab_ray s, BvhNode node) {
    float x0 = (node.low[0] - s.px) * s.ix, x1 = (node.high[0] - s.px) * s.ix;
    float y0 = (node.low[1] - s.py) * s.iy, y1 = (node.high[1] - s.py) * s.iy;
    float z0 = (node.low[2] - s.pz) * s.iz, z1 = (node.high[2] - s.pz) * s.iz;
    float in = fmax(fmax(fmin(x0, x1), fmin(y0, y1)), fmax(fmin(z0, z1), s.t_min));
    float out = fmin(fmin(fmax(x0, x1), fmax(y0, y1)), fmax(z0, z1));
    return in <= out;
}

#endif
