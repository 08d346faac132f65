// Beyond: the sides of a ray that the view's planes cut away. A ray that runs in such a plane keeps only the sides that
// the plane does not cut away.
#ifndef CSGRT_GEOMETRY_BEYOND_H
#define CSGRT_GEOMETRY_BEYOND_H

#include "touch.h"

// Returns MISSED_..., see cover.beyond (boolean/claim.h).
RARE_FN u32 sides_beyond(GLOBAL const Frame* f, ray3 r) {
    u32 k, beyond = 0;
    for (k = 0; k < f->clip_count; ++k)
        if (runs_in(f->clip[k], r)) beyond |= missed_of_plane(f->clip[k], 0, r);
    return beyond;
}

#endif
