// Cut: a solid that planes cut out of another solid, whose crossings with the ray are found one by one and in any
// order. Either the part between two planes is kept, or the parts outside them.
//
//     low                     high
//     -----|=========|=|===============|---------|=============|=====|-----> t
//          x         |  cut off  |     x         x             |     x         x: crossings of the other solid
//
// Crossings in the kept part are the solid's own. At each of the two planes, the parity of the crossings before the
// plane tells whether the ray crosses the plane inside the other solid. If it does, this crossing is the solid's, too.
#ifndef CSGRT_GEOMETRY_CUT_H
#define CSGRT_GEOMETRY_CUT_H

#include "crossings.h"

// A solid under construction between two planes: the crossings that are kept so far, and the parities at the planes.
typedef struct {
    span between;
    int keeps_between;      // 1: the part between the planes is kept; 0: the parts outside
    u32 low_odd, high_odd;  // crossings before between.low, and before between.high
    crossings c;
} cut;

FN cut start_cut(span between, int keeps_between, crossings c) {
    cut k;
    k.between = between;
    k.keeps_between = keeps_between;
    k.low_odd = k.high_odd = 0;
    k.c = c;
    if (!(between.low < between.high)) {  // nothing lies between: every crossing lies before `low` and after `high`
        k.between.low = REAL_INFINITY;
        k.between.high = -REAL_INFINITY;
    }
    return k;
}

FN cut cut_crossing(cut k, real t, u32 surface) {
    int before = t<k.between.low, after = t> k.between.high;
    if (before) k.low_odd ^= 1u;
    if (!after) k.high_odd ^= 1u;
    if ((before || after) != k.keeps_between) k.c = cross(k.c, t, surface);
    return k;
}

FN crossings end_cut(cut k) {
    if (k.low_odd && real_abs(k.between.low) < REAL_INFINITY) k.c = cross(k.c, k.between.low, k.between.low_surface);
    if (k.high_odd && real_abs(k.between.high) < REAL_INFINITY)
        k.c = cross(k.c, k.between.high, k.between.high_surface);
    return k.c;
}

#endif
