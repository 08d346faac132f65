// Tables: the arrays that hold solids' data, and properties of the types of solids.
#ifndef CSGRT_GEOMETRY_TABLES_H
#define CSGRT_GEOMETRY_TABLES_H

#include "../shared/layout.h"

// The tables of a scene that the geometry needs.
typedef struct {
    GLOBAL const SolidRecord* solids;
    GLOBAL const real* reals;
    GLOBAL const PlaneRecord* planes;
    GLOBAL const u32* words;
    GLOBAL const BvhNode* inner_nodes;  // the hierarchies of solids with many elements (meshes, sketches, metaballs)
#ifndef __OPENCL_VERSION__
    u32 quartic;  // the host chooses at run time; a program for a device is compiled for one method
#endif
} Geometry;

// Methods for quartics; quartic.h.
#define QUARTIC_BRACKETED 0
#define QUARTIC_UNSHIFTED 1
#define QUARTIC_FERRARI 2
#define QUARTIC_YUKSEL 3
#ifndef CSGRT_QUARTIC
#define CSGRT_QUARTIC QUARTIC_BRACKETED
#endif
#ifdef __OPENCL_VERSION__
#define QUARTIC_OF(g) CSGRT_QUARTIC
#else
#define QUARTIC_OF(g) (g).quartic
#endif

// Types of solids with more than two segments on some rays.
#define MANY_SEGMENTS                                                                                          \
    (1u << SOLID_EXTRUDE | 1u << SOLID_REVOLVE | 1u << SOLID_MESH | 1u << SOLID_SUPERELL | 1u << SOLID_PLATE | \
     1u << SOLID_HRT | 1u << SOLID_METABALL)

// Types of solids with at most one segment on any ray.
#define ONE_SEGMENT (1u << SOLID_ELL | 1u << SOLID_ARB | 1u << SOLID_HALF | 1u << SOLID_PART)

// The ray that is tested against one solid, with the solid's center.
FN ray3 ray_at(SolidRecord solid, ray3 r) {
#ifdef CSGRT_EYE_RELATIVE
    r.center = make_wide3(solid.center[0], solid.center[1], solid.center[2]);
#else
    (void)solid;
#endif
    return r;
}

FN Geometry make_geometry(GLOBAL const SolidRecord* solids, GLOBAL const real* reals, GLOBAL const PlaneRecord* planes,
                          GLOBAL const u32* words, GLOBAL const BvhNode* inner_nodes) {
    Geometry g;
    g.solids = solids;
    g.reals = reals;
    g.planes = planes;
    g.words = words;
    g.inner_nodes = inner_nodes;
#ifndef __OPENCL_VERSION__
    g.quartic = CSGRT_QUARTIC;
#endif
    return g;
}

#endif
