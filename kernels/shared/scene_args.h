// Kernel arguments that are tables of the scene, in groups. On the host one call sets a group (SceneTables,
// src/pipeline/passes).
#ifndef CSGRT_SHARED_SCENE_ARGS_H
#define CSGRT_SHARED_SCENE_ARGS_H

#include "layout.h"

// Geometry: solids and the tables that they refer to.
#define GEOMETRY_ARGS                                                                                   \
    __global const SolidRecord *solids, __global const real *reals, __global const PlaneRecord *planes, \
        __global const u32 *words, __global const BvhNode *inner_nodes
#define GEOMETRY make_geometry(solids, reals, planes, words, inner_nodes)

// Regions' terms and their trees.
#define REGION_ARGS __global const StartRecord *starts, __global const u32 *trees

// Appearance: the regions' materials, by number, the frame's lights, and a display's bytes.
#define APPEARANCE_ARGS \
    __global const MaterialRecord *materials, __global const LightRecord *lights, __global const DisplayBytes *display

#define EVALUATION_ARGS __global const SolidRecord *solids, REGION_ARGS

#endif
