// Beam: one thick ray for all rays of a tile. It is the ray through the tile's middle, so thick that it contains the
// tile's rays within the scene's sphere.
//
// Take a point of one of the rays, and the point of the middle ray at the same distance from the eye (parallel rays:
// from the picture plane). The distance between these points is at most the beam's `spread`. So where the middle ray
// enters a box that is larger by the spread, no ray of the tile has entered the box itself yet.
#ifndef CSGRT_TRAVERSAL_BEAM_H
#define CSGRT_TRAVERSAL_BEAM_H

#include "camera.h"
#include "../shared/slab.h"

// The middle ray of a tile, and its thickness.
typedef struct {
    slab_ray slabs;
    float pad;   // how much boxes grow
    wide start;  // where the middle ray's parameter is 0: a distance from the eye
    wide to_center;
    float end;  // boxes that the middle ray enters later are not listed
} beam;

// The distance of the scene's center from the eye, or from the picture plane.
FN wide distance_of_center(GLOBAL const Frame* f) {
    wide3 to = wide_subtract(frame_center(f), make_wide3(f->eye[0], f->eye[1], f->eye[2]));
    return f->perspective ? wide_sqrt(wide_dot(to, to)) : wide_dot(to, make_wide3(f->w[0], f->w[1], f->w[2]));
}

FN beam make_beam(GLOBAL const Frame* f, u32 tile) {
    wide3 u = make_wide3(f->u[0], f->u[1], f->u[2]), v = make_wide3(f->v[0], f->v[1], f->v[2]);
    wide3 w = make_wide3(f->w[0], f->w[1], f->w[2]);
    wide across = (wide)(TILE / 2) * (wide_sqrt(wide_dot(u, u)) + wide_sqrt(wide_dot(v, v)));
    pixel_position at = pixel_of(tile * TILE * TILE, f->screen);
    real spread, reach;
    ray3 r;
    beam b;
    at.x += TILE / 2;
    at.y += TILE / 2;
    r = geometry_ray(f, camera_ray(f, at));
    b.to_center = distance_of_center(f);
    if (f->perspective) across = across * (b.to_center + f->radius) / wide_sqrt(wide_dot(w, w));
    spread = REAL(across) * REAL(1.001);
    reach = REAL(f->radius) + spread;
    b.slabs = make_slab_ray(offset_from(frame_center(f), r.o), r.d, reach,
                            f->whole_lines ? -REAL_INFINITY : t_min_along(f, r));
    b.pad = (float)(spread + reach * REAL(0x1p-19));
    b.start = (wide)distance_along(r, 0);
    b.end = BOX_MISSED;
    return b;
}

// Ends the beam so far behind `end`, a distance from the eye, that no boundary of a later box joins an event before
// `end` or before the eye.
FN void end_beam(beam* b, GLOBAL const Frame* f, float end) {
    const wide at = wide_max((wide)end, (wide)0), rounding = at + wide_abs(b->to_center) + (wide)f->radius,
               slack = 4 * (wide)f->tolerance + rounding * (wide)0x1p-18 + (wide)b->pad;
    if (end < BOX_MISSED) b->end = end_of_range(b->slabs, REAL(f->radius) + REAL(b->pad), REAL(at + slack - b->start));
}

// The list of nodes of the tile with ray `number`.
FN GLOBAL const TileNode* list_of(GLOBAL const Frame* f, GLOBAL const TileNode* lists, u32 number) {
    return lists + (size_t)((number - f->first_ray) / (TILE * TILE)) * LISTED_NODES;
}

// Returns where the middle ray enters the larger box; BOX_MISSED: no ray of the beam enters the box.
FN float beam_entry(beam b, BvhNode node) {
    u32 k;
    for (k = 0; k < 3; ++k) {
        node.low[k] = node.low[k] - b.pad;
        node.high[k] = node.high[k] + b.pad;
    }
    return box_entry(b.slabs, node);
}

FN TileNode entry_of(beam b, GLOBAL const BvhNode* nodes, u32 node) {
    TileNode e;
    e.node = node;
    e.entry = beam_entry(b, nodes[node]);
    if (e.entry > b.end) e.entry = BOX_MISSED;
    return e;
}

// The distance that the list stores, relative to the scene's center. A box that is entered before t_min may hold a
// segment that begins even earlier.
FN float entry_from_center(beam b, float at) {
    if (at <= b.slabs.t_min) return -BOX_MISSED;
    return (float)(b.start + (wide)distance_before(b.slabs, at) - b.to_center) - b.pad;
}

// The difference between the list's distances and the parameter of one of the beam's rays.
FN wide offset_along(GLOBAL const Frame* f, ray3 r) { return distance_of_center(f) - (wide)distance_along(r, 0); }

#endif
