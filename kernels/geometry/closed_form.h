// Closed form: the solids that are intersected for packets of rays, too. The file is compiled for one ray and for a
// packet (packet/begin.h).
#ifndef CSGRT_GEOMETRY_CLOSED_FORM_H
#define CSGRT_GEOMETRY_CLOSED_FORM_H

#include "arb.h"
#include "ehy.h"
#include "ell.h"
#include "half.h"
#include "quadric.h"
#include "tgc.h"
#include "tor.h"

#ifndef CSGRT_SOLIDS
#define CSGRT_SOLIDS 0xffffffffu
#endif

#define HAS_SOLID(type) ((CSGRT_SOLIDS) >> (type)&1u)

#define CLOSED_FORM_SOLIDS                                                                                        \
    (1u << SOLID_ELL | 1u << SOLID_TGC | 1u << SOLID_ARB | 1u << SOLID_HALF | 1u << SOLID_TOR | 1u << SOLID_EHY | \
     1u << SOLID_QUADRIC)

FN segments closed_form_intersect(Geometry g, SolidRecord solid, ray3 r) {
#if HAS_SOLID(SOLID_ELL)
    if (solid.type == SOLID_ELL) return ell_intersect(g.reals + solid.first_real, r);
#endif
#if HAS_SOLID(SOLID_TGC)
    if (solid.type == SOLID_TGC) return tgc_intersect(g, solid, r);
#endif
#if HAS_SOLID(SOLID_ARB)
    if (solid.type == SOLID_ARB) return arb_intersect(g, solid, r);
#endif
#if HAS_SOLID(SOLID_HALF)
    if (solid.type == SOLID_HALF) return half_intersect(g, solid, r);
#endif
#if HAS_SOLID(SOLID_TOR)
    if (solid.type == SOLID_TOR) return tor_intersect(g, solid, r);
#endif
#if HAS_SOLID(SOLID_EHY)
    if (solid.type == SOLID_EHY) return ehy_intersect(g, solid, r);
#endif
#if HAS_SOLID(SOLID_QUADRIC)
    if (solid.type == SOLID_QUADRIC) return quadric_intersect(g, solid, r);
#endif
    return no_segments();
}

// A vector along the outward normal where `surface`, without MISSED_..., is hit at t. 0, 0, 0 for other solids.
FN vec3 closed_form_normal(Geometry g, SolidRecord solid, ray3 r, real t, u32 surface) {
    vec3 n = make_vec3(0, 0, 0);
#if HAS_SOLID(SOLID_ELL)
    if (solid.type == SOLID_ELL) n = ell_normal(g.reals + solid.first_real, r, t);
#endif
#if HAS_SOLID(SOLID_TGC)
    if (solid.type == SOLID_TGC) n = tgc_normal(g, solid, r, t, surface);
#endif
#if HAS_SOLID(SOLID_ARB)
    if (solid.type == SOLID_ARB) n = face_normal(g, solid.first_plane + surface);
#endif
#if HAS_SOLID(SOLID_HALF)
    if (solid.type == SOLID_HALF) n = face_normal(g, solid.first_plane);
#endif
#if HAS_SOLID(SOLID_TOR)
    if (solid.type == SOLID_TOR) n = tor_normal(g, solid, r, t, surface);
#endif
#if HAS_SOLID(SOLID_EHY)
    if (solid.type == SOLID_EHY) n = ehy_normal(g, solid, r, t, surface);
#endif
#if HAS_SOLID(SOLID_QUADRIC)
    if (solid.type == SOLID_QUADRIC) n = quadric_normal(g, solid, r, t, surface);
#endif
    return n;
}

#endif
