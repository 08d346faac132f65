// Solid: the segments of any type of solid that has at most two, and the normal of any solid. Types are
// named here, in collect.h, tables.h, touch.h and packet/closed_form.h. A program has only the types of its scene
// (-DCSGRT_SOLIDS=<bits>): code that is left out costs no registers.
#ifndef CSGRT_GEOMETRY_SOLID_H
#define CSGRT_GEOMETRY_SOLID_H

#include "closed_form.h"
#include "crossed_eto.h"
#include "eto.h"
#include "extrude.h"
#include "hrt.h"
#include "mesh.h"
#include "metaball.h"
#include "part.h"
#include "plate.h"
#include "revolve.h"
#include "superell.h"

FN segments intersect(Geometry g, SolidRecord solid, ray3 r) {
#if HAS_SOLID(SOLID_ETO)
    if (solid.type == SOLID_ETO) return eto_intersect(g, solid, r);
#endif
#if HAS_SOLID(SOLID_CROSSED_ETO)
    if (solid.type == SOLID_CROSSED_ETO) return crossed_eto_intersect(g, solid, r);
#endif
#if HAS_SOLID(SOLID_PART)
    if (solid.type == SOLID_PART) return part_intersect(g.reals + solid.first_real, r);
#endif
    return closed_form_intersect(g, solid, r);
}

// A vector along the outward normal of a solid where its `surface` is hit at t, of any length.
FN vec3 normal_of_any_length(Geometry g, SolidRecord solid, ray3 r, real t, u32 surface) {
    vec3 n;
    r = ray_at(solid, r);
    surface &= ~MISSED;
    n = closed_form_normal(g, solid, r, t, surface);
#if HAS_SOLID(SOLID_ETO)
    if (solid.type == SOLID_ETO) n = eto_normal(g.reals + solid.first_real, r, t);
#endif
#if HAS_SOLID(SOLID_CROSSED_ETO)
    if (solid.type == SOLID_CROSSED_ETO) n = crossed_eto_normal(g.reals + solid.first_real, r, t);
#endif
#if HAS_SOLID(SOLID_SUPERELL)
    if (solid.type == SOLID_SUPERELL) n = superell_normal(g.reals + solid.first_real, r, t);
#endif
#if HAS_SOLID(SOLID_EXTRUDE)
    if (solid.type == SOLID_EXTRUDE) n = extrude_normal(g, solid, r, t, surface);
#endif
#if HAS_SOLID(SOLID_HRT)
    if (solid.type == SOLID_HRT) n = hrt_normal(g.reals + solid.first_real, r, t);
#endif
#if HAS_SOLID(SOLID_METABALL)
    if (solid.type == SOLID_METABALL) n = metaball_normal(g, solid, r, t);
#endif
#if HAS_SOLID(SOLID_PART)
    if (solid.type == SOLID_PART) n = part_normal(g.reals + solid.first_real, r, t);
#endif
#if HAS_SOLID(SOLID_MESH)
    if (solid.type == SOLID_MESH)
        n = mesh_normal(g, g.words + solid.first_word, g.reals + solid.first_real, r, surface);
#endif
#if HAS_SOLID(SOLID_PLATE)
    if (solid.type == SOLID_PLATE)
        n = mesh_normal(g, g.words + solid.first_word + PLATE_MESH, g.reals + solid.first_real, r, surface);
#endif
#if HAS_SOLID(SOLID_REVOLVE)
    if (solid.type == SOLID_REVOLVE) n = revolve_normal(g, solid, r, t, surface);
#endif
    return n;
}

// The outward unit normal. Where a surface has no normal (an apex), a unit vector against the ray.
FN vec3 normal_at(Geometry g, SolidRecord solid, ray3 r, real t, u32 surface) {
    return unit_or_against(normal_of_any_length(g, solid, r, t, surface), r.d);
}

#endif
