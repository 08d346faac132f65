// Packet: compiles the closed-form solids once more, for eight rays side by side. Packets are for processors, whose
// instructions work on vectors. A packet is two rows of four pixels of a tile, which meet fewer boxes and solids than
// one row of eight. begin.h says how the source of one ray is compiled for a packet, and why the bits are the same.
#ifndef CSGRT_PACKET_PACKET_H
#define CSGRT_PACKET_PACKET_H

#include "../traversal/camera.h"
#include "../geometry/solid.h"
#include "../shading/plastic.h"
#include "../shared/slab.h"
#include "../traversal/bvh_cursor.h"

#define PACKET 8u

// Prefetch: the processor loads a line of memory ahead, in scenes larger than its caches. The processor does not wait,
// and any address is harmless.
#ifdef CSGRT_PREFETCH
#define prefetch_line(place) __builtin_prefetch((const void*)(size_t)(place))
#else
#define prefetch_line(place) ((void)0)
#endif

FN double8 real_sqrt(double8 x) { return sqrt(x); }
FN double8 real_fma(double8 a, double8 b, double8 c) { return fma(a, b, c); }
FN double8 real_abs(double8 x) { return fabs(x); }
FN double8 real_min(double8 a, double8 b) { return a < b ? a : b; }
FN double8 real_max(double8 a, double8 b) { return a > b ? a : b; }
FN float8 single_min(float8 a, float8 b) { return a < b ? a : b; }
FN float8 single_max(float8 a, float8 b) { return a > b ? a : b; }
FN float8 to_single(double8 x) { return convert_float8(x); }
FN int no_lane(long8 x) { return !any(x); }

#include "begin.h"
#include "../shared/vectors.h"
#include "../shared/slab.h"
#include "../traversal/view.h"
#include "../geometry/segments.h"
#include "../geometry/affine.h"
#include "../geometry/plane.h"
#include "../geometry/quadratic.h"
#include "../geometry/arb.h"
#include "../geometry/ell.h"
#include "../geometry/half.h"
#include "../geometry/cone.h"
#include "../geometry/torus.h"
#include "closed_form.h"
#include "../geometry/ehy.h"
#include "../geometry/quadric.h"
#include "../geometry/closed_form.h"
#include "../shading/plastic.h"
#include "end.h"

// Is this type of solid intersected by packets?
FN int takes_packets(SolidRecord solid) { return CLOSED_FORM_SOLIDS >> solid.type & 1u; }

// The segments of a closed-form solid: for each ray one, none, or UNDECIDED. A ray that may only touch the solid is
// UNDECIDED.
FN packet_segments packet_intersect(Geometry g, SolidRecord solid, packet_ray3 r) {
    packet_segments h = closed_form_intersect(g, solid, r);
    h.count = h.touched ? (ulong8)UNDECIDED : h.count;
    return h;
}

// Vectors along the outward normals where the rays hit one surface of a closed-form solid at t. Returns 0 if the
// surface is a plane.
FN int packet_normals(Geometry g, SolidRecord solid, packet_ray3 r, double8 t, u32 surface, packet_vec3* n) {
    surface &= ~MISSED;
    if (surface != 0 || solid.type == SOLID_ARB || solid.type == SOLID_HALF) return 0;
    *n = closed_form_normal(g, solid, r, t, surface);
    return 1;
}

// The mask of a comparison: bit k for ray k.
FN u32 bits_of(int8 x) {
    return (u32)((as_ulong(convert_char8(x)) & 0x8040201008040201ul) * 0x0101010101010101ul >> 56);
}
FN u32 bits_of(long8 x) { return bits_of(convert_int8(x)); }
FN int8 of_bits(u32 bits) { return ((int8)((int)bits) & (int8)(1, 2, 4, 8, 16, 32, 64, 128)) != 0; }

// Numbers of rays. A work-item has eight numbers (or positions) in a row, but the rays of a packet are two rows of four
// pixels of the tile. first_of_packet: the first ray's number. ray_of_packet: the number of ray k minus the number of
// the first ray.
#define PACKET_ROW 4u
FN u32 first_of_packet(u32 id) {
    const u32 within = id % (TILE * TILE) / PACKET;
    return id - id % (TILE * TILE) + within / 2u * (2u * TILE) + within % 2u * PACKET_ROW;
}
FN u32 ray_of_packet(u32 k) { return k / PACKET_ROW * TILE + k % PACKET_ROW; }

// The rays through the pixels of a packet. `first`: its first pixel, which is in the picture.
FN packet_world_ray rays_through(__global const Frame* f, pixel_position first) {
    return view_ray(f, (double)first.x + (double8)(0, 1, 2, 3, 0, 1, 2, 3),
                    (double)first.y + (double8)(0, 0, 0, 0, 1, 1, 1, 1));
}

// The mask of the rays whose pixels are in the picture.
FN u32 rays_inside(__global const Frame* f, pixel_position first) {
    const u32 columns = f->screen.right - first.x,
              row = columns < PACKET_ROW ? (1u << columns) - 1u : (1u << PACKET_ROW) - 1u;
    return first.y + 1u < f->screen.bottom ? row | row << PACKET_ROW : row;
}

FN packet_slab_ray slabs_of(__global const Frame* f, packet_world_ray r, double8 t_min) {
    return make_slab_ray(offset_from(packet_make_wide3(f->center[0], f->center[1], f->center[2]), r.o), r.d, f->radius,
                         t_min);
}

// The next leaf, as for one ray (traversal/bvh_cursor.h), for the active rays; *hit_mask: the active rays that hit it.
FN u32 next_leaf(packet_slab_ray s, __global const BvhNode* nodes, bvh_cursor* c, u32 active_mask, u32* hit_mask) {
    u32 leaf = 0;
    while (!leaf && bvh_goes_on(*c)) {
        BvhNode node;
        // A loop of its own: the node after a missed box is then loaded before the test of the box is done.
        do {
            node = nodes[c->node];
            *hit_mask = bits_of(box_is_hit(s, node)) & active_mask;
            if (!*hit_mask) bvh_step(c, node, 0);
        } while (!*hit_mask && bvh_goes_on(*c));
        if (*hit_mask) {
            prefetch_line(nodes + node.skip);
            leaf = bvh_step(c, node, 1);
        }
    }
    return leaf;
}

// The rays of a packet in arrays, from which one ray can be read.
typedef struct {
    real ox[PACKET], oy[PACKET], oz[PACKET], dx[PACKET], dy[PACKET], dz[PACKET];
} packet_lanes;

FN packet_lanes lanes_of(packet_ray3 r) {
    packet_lanes lanes;
    vstore8(r.o.x, 0, lanes.ox);
    vstore8(r.o.y, 0, lanes.oy);
    vstore8(r.o.z, 0, lanes.oz);
    vstore8(r.d.x, 0, lanes.dx);
    vstore8(r.d.y, 0, lanes.dy);
    vstore8(r.d.z, 0, lanes.dz);
    return lanes;
}

FN ray3 lane(const packet_lanes* lanes, u32 k) {
    ray3 r;
    r.o = make_wide3(lanes->ox[k], lanes->oy[k], lanes->oz[k]);
    r.d = make_vec3(lanes->dx[k], lanes->dy[k], lanes->dz[k]);
    return r;
}

#endif
