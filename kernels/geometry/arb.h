// arb4 to arb8 and arbn: a convex polyhedron. Its segment is the part of the ray that lies inside all faces' planes. No
// reals. Planes and surfaces: the faces.
#ifndef CSGRT_GEOMETRY_ARB_H
#define CSGRT_GEOMETRY_ARB_H

#include "plane.h"

FN segments arb_intersect(Geometry g, SolidRecord solid, ray3 r) {
    span s = whole_line();
    u32 i;
    for (i = 0; i < solid.plane_count; ++i) {
        s = clip_to_face(s, g, solid.first_plane + i, r, i);
        if (no_lane(s.low < s.high)) return no_segments();
    }
    return append_span(no_segments(), s);
}

#endif
