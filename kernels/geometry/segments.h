// Segments: a solid's segments along a ray, in ascending order.
//
//        in0      out0         in1      out1
//   -----|=========|-----------|=========|-----> t        count = 2
//
// `surface` numbers the surfaces of a solid; each <solid>.h says which number is which surface.
#ifndef CSGRT_GEOMETRY_SEGMENTS_H
#define CSGRT_GEOMETRY_SEGMENTS_H

#include "tables.h"

// Up to two segments of a ray in one solid.
typedef struct {
    tag count;  // segments: 0, 1 or 2
    real in0, out0, in1, out1;
    tag in0_surface, out0_surface, in1_surface, out1_surface;
    lane_mask touched;  // the ray may only touch the solid; touch.h tests more exactly
} segments;

// An interval of the ray, with the surfaces that bound it.
typedef struct {
    real low, high;
    tag low_surface, high_surface;
    lane_mask touched;  // the ray runs in one of the solid's planes
} span;

FN segments no_segments(void) {
    segments h;
    h.count = 0;
    h.in0 = h.out0 = h.in1 = h.out1 = 0;
    h.in0_surface = h.out0_surface = h.in1_surface = h.out1_surface = 0;
    h.touched = 0;
    return h;
}

FN span whole_line(void) {
    span s;
    s.low = -REAL_INFINITY;
    s.high = REAL_INFINITY;
    s.low_surface = s.high_surface = 0;
    s.touched = 0;
    return s;
}

// Appends [in, out] unless it is empty. A ray that only touches the solid has no segment there.
FN segments append(segments h, real in, tag in_surface, real out, tag out_surface) {
    const lane_mask first = in < out && h.count == 0, second = in < out && h.count == 1;
    h.in0 = first ? in : h.in0;
    h.out0 = first ? out : h.out0;
    h.in0_surface = first ? in_surface : h.in0_surface;
    h.out0_surface = first ? out_surface : h.out0_surface;
    h.in1 = second ? in : h.in1;
    h.out1 = second ? out : h.out1;
    h.in1_surface = second ? in_surface : h.in1_surface;
    h.out1_surface = second ? out_surface : h.out1_surface;
    h.count = first || second ? h.count + TAG(1) : h.count;
    return h;
}

FN segments touching(lane_mask touched, segments h) {
    h.touched = touched;
    return h;
}

FN segments append_span(segments h, span s) {
    return touching(s.touched, append(h, s.low, s.low_surface, s.high, s.high_surface));
}

#endif
