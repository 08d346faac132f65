// Half-space: one plane; the segment extends to infinity on one side, or on both. No reals. Surface 0.
#ifndef CSGRT_GEOMETRY_HALF_H
#define CSGRT_GEOMETRY_HALF_H

#include "plane.h"

FN segments half_intersect(Geometry g, SolidRecord solid, ray3 r) {
    span s = clip_to_face(whole_line(), g, solid.first_plane, r, 0);
    return append_span(no_segments(), s);
}

#endif
