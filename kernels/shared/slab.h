// Slabs: the test of rays against the boxes of a bounding volume hierarchy, in float.
//
// The slab test may report a box that the ray misses, but it reports every box that the ray hits. The origin is moved
// to the ray's closest approach to the hierarchy's center, so |p| <= radius. Then the errors of p, 1/d and the products
// amount to less than radius * 2^-21 of displacement an axis, and boxes are padded by radius * 2^-20 when they are
// built. In single precision boxes grow with the distance of the ray's origin: there a ray may meet a solid that is a
// little beside the ray.
#ifndef CSGRT_SHARED_SLAB_H
#define CSGRT_SHARED_SLAB_H

#include "layout.h"

// A ray for the slab test, in float, relative to the hierarchy's center.
typedef struct {
    single px, py, pz;      // a point of the ray, relative to the center
    single ix, iy, iz;      // 1 / direction, or MOST_INVERSE
    single t_min;           // in the hierarchy's own parameter
    single pad;             // single precision: how much boxes grow
    lane_mask hits_sphere;  // 0: the ray can hit nothing
    real shift, length;     // the hierarchy's parameter is length * t - shift
} slab_ray;

#define SLAB_REACH BY_PRECISION(1.001, 1.0000001, 1.0000001)
#define SLAB_SLACK BY_PRECISION(0x1p-10, 0x1p-20, 0x1p-20)  // covers the rounding of t_min to float

// The largest inverse: so large that a ray parallel to a slab never leaves this slab within the sphere. Infinity times
// 0 would be a NaN.
#define MOST_INVERSE 1e30f
FN single inverse(single x) {
    const single i = SINGLE(1) / x;
    return i < SINGLE(-MOST_INVERSE) ? SINGLE(-MOST_INVERSE) : i > SINGLE(MOST_INVERSE) ? SINGLE(MOST_INVERSE) : i;
}

// Makes a slab_ray. `o`: the ray's origin relative to the center, around which all boxes lie within `radius`. Segments
// that end before t_min are not wanted.
FN slab_ray make_slab_ray(offset3 o, vec3 direction, real radius, real t_min) {
    slab_ray s;
    real length = real_sqrt(dot3(direction, direction));
    vec3 d = scale(direction, REAL(1) / length);
    real shift = -dot3(leading(o), d);
    vec3 p = moved(o, shift, d);
    real pad = (radius + real_max(real_abs(o.x.hi), real_max(real_abs(o.y.hi), real_abs(o.z.hi)))) * REAL(0x1p-16);
    real reach = radius * SLAB_REACH;
    s.pad = to_single(pad);
    s.shift = shift;
    s.length = length;
    if (sizeof(real) == 4) reach = reach + REAL(2) * pad;
    s.hits_sphere = dot3(p, p) <= reach * reach;
    s.px = to_single(p.x);
    s.py = to_single(p.y);
    s.pz = to_single(p.z);
    s.ix = inverse(to_single(d.x));
    s.iy = inverse(to_single(d.y));
    s.iz = inverse(to_single(d.z));
    s.t_min = to_single(real_max(t_min * length - shift, REAL(-4) * radius) - radius * SLAB_SLACK);
    return s;
}

FN single grown(float x, single pad) { return sizeof(real) == 4 ? x + pad : SINGLE(x); }

#define BOX_MISSED 3.0e38f

// Returns where the ray enters the box, or an earlier distance, in the hierarchy's parameter. The ray misses the box if
// the result is greater than *out. A ray along a padded face, which is outside the true box, may get either answer.
FN single box_passage(slab_ray s, BvhNode node, single* out) {
    const single x0 = (grown(node.low[0], -s.pad) - s.px) * s.ix, x1 = (grown(node.high[0], s.pad) - s.px) * s.ix;
    const single y0 = (grown(node.low[1], -s.pad) - s.py) * s.iy, y1 = (grown(node.high[1], s.pad) - s.py) * s.iy;
    const single z0 = (grown(node.low[2], -s.pad) - s.pz) * s.iz, z1 = (grown(node.high[2], s.pad) - s.pz) * s.iz;
    *out = single_min(single_min(single_max(x0, x1), single_max(y0, y1)), single_max(z0, z1));
    return single_max(single_max(single_min(x0, x1), single_min(y0, y1)), single_max(single_min(z0, z1), s.t_min));
}

FN single_lane_mask box_is_hit(slab_ray s, BvhNode node) {
    single out;
    const single in = box_passage(s, node, &out);
    return in <= out;
}

// Returns an upper bound of t_max in the hierarchy's parameter: boxes that the ray enters later are not wanted.
FN single end_of_range(slab_ray s, real radius, real t_max) {
    return to_single(real_min(t_max * s.length - s.shift, REAL(4) * radius) + radius * SLAB_SLACK);
}
FN single_lane_mask box_is_hit_before(slab_ray s, BvhNode node, single end) {
    single out;
    const single in = box_passage(s, node, &out);
    return in <= out && in <= end;
}

// Returns where the ray enters the box, or BOX_MISSED.
FN single box_entry(slab_ray s, BvhNode node) {
    single out;
    const single in = box_passage(s, node, &out);
    return in <= out ? in : SINGLE(BOX_MISSED);
}

// A lower bound of the distances along the ray at which the content of a box begins. `at`: where the ray enters the
// box. The box's padding covers the rounding of its own test, but not the rounding of a far origin's distance.
FN real distance_before(slab_ray s, float at) {
    return (REAL(at) + s.shift - real_abs(s.shift) * BY_PRECISION(0x1p-20, 0x1p-49, 0x1p-100)) / s.length;
}

#endif
