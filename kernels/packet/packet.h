// The closed-form solids once more, for a packet of rays side by side: two rows of four pixels of a tile, which meet fewer boxes and
// solids than one row of eight. For processors, whose work-items have vectors: what a ray waits for, others use.
//
// The source is the same (one ray's `real` becomes a vector), so the bits are: vectors round each number as scalars do.
#ifndef CSGRT_PACKET_PACKET_H
#define CSGRT_PACKET_PACKET_H

#include "../traversal/camera.h"
#include "../geometry/solid.h"
#include "../shading/plastic.h"
#include "../shared/slab.h"

#define PACKET 8u

// Asks for the line of memory there, where a scene is larger than the processor's caches: no wait, and no harm if nothing is there.
#ifdef CSGRT_FETCH
#define fetch(place) __builtin_prefetch((const void*)(size_t)(place))
#else
#define fetch(place) ((void)0)
#endif

FN double8 real_sqrt(double8 x) { return sqrt(x); }
FN double8 real_fma(double8 a, double8 b, double8 c) { return fma(a, b, c); }
FN double8 real_abs(double8 x) { return fabs(x); }
FN double8 real_min(double8 a, double8 b) { return a < b ? a : b; }
FN double8 real_max(double8 a, double8 b) { return a > b ? a : b; }
FN float8 single_min(float8 a, float8 b) { return a < b ? a : b; }
FN float8 single_max(float8 a, float8 b) { return a > b ? a : b; }
FN float8 to_single(double8 x) { return convert_float8(x); }
FN int none(long8 x) { return !any(x); }

// What base.h calls these of one ray.
#define real double8
#define wide double8
#define single float8
#define truth long8
#define single_truth int8
#define tag ulong8

// Types, and functions whose arguments do not tell the two kinds apart.
#define vec3 packet_vec3
#define wide3 packet_wide3
#define pair packet_pair
#define offset3 packet_offset3
#define world_ray packet_world_ray
#define ray3 packet_ray3
#define slab_ray packet_slab_ray
#define hits packet_hits
#define span packet_span
#define local_ray packet_local_ray
#define quadratic packet_quadratic
#define tor_piece packet_tor_piece
#define sight packet_sight
#define finish packet_finish
#define rgb packet_rgb
#define make_vec3 packet_make_vec3
#define make_wide3 packet_make_wide3
#define no_hits packet_no_hits
#define whole_line packet_whole_line
#define plane_normal packet_plane_normal
#define face_normal packet_face_normal

#undef CSGRT_SHARED_VECTORS_H
#undef CSGRT_TRAVERSAL_VIEW_H
#undef CSGRT_SHARED_SLAB_H
#undef CSGRT_GEOMETRY_HITS_H
#undef CSGRT_GEOMETRY_AFFINE_H
#undef CSGRT_GEOMETRY_PLANE_H
#undef CSGRT_GEOMETRY_QUADRATIC_H
#undef CSGRT_GEOMETRY_ARB_H
#undef CSGRT_GEOMETRY_ELL_H
#undef CSGRT_GEOMETRY_HALF_H
#undef CSGRT_GEOMETRY_CONE_H
#undef CSGRT_GEOMETRY_TORUS_H
#undef CSGRT_GEOMETRY_EHY_H
#undef CSGRT_GEOMETRY_QUADRIC_H
#undef CSGRT_SHADING_PLASTIC_H
#include "../shared/vectors.h"
#include "../traversal/view.h"
#include "../shared/slab.h"
#include "../geometry/hits.h"
#include "../geometry/affine.h"
#include "../geometry/plane.h"
#include "../geometry/quadratic.h"
#include "../geometry/arb.h"
#include "../geometry/ell.h"
#include "../geometry/half.h"
#include "../geometry/cone.h"
#include "../geometry/torus.h"
#include "../shading/plastic.h"

// A packet's count of segments where it takes more than is here to know: the ray is to go alone.
#define UNDECIDED 3u

FN hits undecided_where(truth which, hits h) {
    h.count = which ? TAG(UNDECIDED) : h.count;
    return h;
}

// As one ray's (polynomial.h), where a > 0.
FN hits quadratic_inside(real a, real b, real c, real discriminant, real shift, span s, u32 surface) {
    return undecided_where(s.low < s.high && !(a > 0), between_roots(a, b, c, discriminant, shift, s, surface));
}

#include "../geometry/ehy.h"
#include "../geometry/quadric.h"

// As one ray's (tgc.h), of those that are less steep than the cone; and the others', as far as no quartic is to be solved.
FN hits tgc_intersect(Geometry g, SolidRecord solid, ray3 r) {
    GLOBAL const parameter* p = g.reals + solid.first_real;
    span s = between_ends(g, solid, r);
    local_ray l;
    if (none(s.low < s.high)) return no_hits();
    l = quartic_ray(p[16] == 0 ? QUARTIC_BRACKETED : QUARTIC_OF(g), p, r);
    if (p[16] == 0) {
        const real m0 = real_fma(p[13], l.o.z, p[12]);
        const quadratic f = round_side(l, m0, p[13] * l.d.z);
        const hits h = quadratic_inside(f.a, f.b, f.c, f.discriminant, l.shift, s, TGC_SIDE);
        return touching(s.touched || may_touch_side(l, f, m0), h);
    }
    s = tapered_piece(QUARTIC_OF(g), p, l, s);
    return undecided_where(s.low < s.high, no_hits());
}

// As far as no quartic is to be solved.
FN hits tor_intersect(Geometry g, SolidRecord solid, ray3 r) {
    const span s = tor_bend(g, solid, r);
    tor_piece piece;
    if (none(s.low < s.high)) return no_hits();
    piece = tor_piece_of(QUARTIC_OF(g), g.reals + solid.first_real, r);
    return undecided_where(s.low < s.high && piece.low < piece.high, no_hits());
}

#undef real
#undef wide
#undef single
#undef truth
#undef single_truth
#undef tag
#undef vec3
#undef wide3
#undef pair
#undef offset3
#undef world_ray
#undef ray3
#undef slab_ray
#undef hits
#undef span
#undef local_ray
#undef quadratic
#undef tor_piece
#undef sight
#undef finish
#undef rgb
#undef make_vec3
#undef make_wide3
#undef no_hits
#undef whole_line
#undef plane_normal
#undef face_normal

// Is it a solid that packets know?
FN int takes_packets(SolidRecord solid) {
    return (1u << SOLID_ARB | 1u << SOLID_ELL | 1u << SOLID_HALF | 1u << SOLID_TGC | 1u << SOLID_TOR | 1u << SOLID_EHY |
            1u << SOLID_QUADRIC) >> solid.type & 1u;
}

// What each ray meets of such a solid: a segment, none, or UNDECIDED; one that may only touch it is looked at alone.
FN packet_hits packet_meet(Geometry g, SolidRecord solid, packet_ray3 r) {
#if HAS_SOLID(SOLID_ARB)
    if (solid.type == SOLID_ARB) return arb_intersect(g, solid, r);
#endif
#if HAS_SOLID(SOLID_ELL)
    if (solid.type == SOLID_ELL) return ell_intersect(g.reals + solid.first_real, r);
#endif
#if HAS_SOLID(SOLID_HALF)
    if (solid.type == SOLID_HALF) return half_intersect(g, solid, r);
#endif
#if HAS_SOLID(SOLID_TGC)
    if (solid.type == SOLID_TGC) return tgc_intersect(g, solid, r);
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
    return packet_no_hits();
}

FN packet_hits packet_intersect(Geometry g, SolidRecord solid, packet_ray3 r) {
    packet_hits h = packet_meet(g, solid, r);
    h.count = h.touched ? (ulong8)UNDECIDED : h.count;
    return h;
}

// Along the outward normals where rays hit the same surface of such a solid at t; 0: it is a plane.
FN int packet_normals(Geometry g, SolidRecord solid, packet_ray3 r, double8 t, u32 surface, packet_vec3* n) {
    surface &= ~MISSED;
    if (surface != 0 || solid.type == SOLID_ARB || solid.type == SOLID_HALF) return 0;
#if HAS_SOLID(SOLID_ELL)
    if (solid.type == SOLID_ELL) *n = ell_normal(g.reals + solid.first_real, r, t);
#endif
#if HAS_SOLID(SOLID_TGC)
    if (solid.type == SOLID_TGC) *n = tgc_normal(g, solid, r, t, surface);
#endif
#if HAS_SOLID(SOLID_TOR)
    if (solid.type == SOLID_TOR) *n = tor_normal(g, solid, r, t, surface);
#endif
#if HAS_SOLID(SOLID_EHY)
    if (solid.type == SOLID_EHY) *n = ehy_normal(g, solid, r, t, surface);
#endif
#if HAS_SOLID(SOLID_QUADRIC)
    if (solid.type == SOLID_QUADRIC) *n = quadric_normal(g, solid, r, t, surface);
#endif
    return 1;
}

// Bit k: ray k.
FN u32 bits_of(int8 x) {
    return (u32)((as_ulong(convert_char8(x)) & 0x8040201008040201ul) * 0x0101010101010101ul >> 56);
}
FN u32 bits_of(long8 x) { return bits_of(convert_int8(x)); }
FN int8 of_bits(u32 bits) { return ((int8)((int)bits) & (int8)(1, 2, 4, 8, 16, 32, 64, 128)) != 0; }

// An item has a packet for every eight numbers (or places) in a row, but its rays have others: those of two rows of four pixels. From
// the row's first to the first ray's; and how far from there ray k's is.
#define PACKET_ROW 4u
FN u32 first_of_packet(u32 id) {
    const u32 within = id % (TILE * TILE) / PACKET;
    return id - id % (TILE * TILE) + within / 2u * (2u * TILE) + within % 2u * PACKET_ROW;
}
FN u32 ray_of_packet(u32 k) { return k / PACKET_ROW * TILE + k % PACKET_ROW; }

// The rays through the pixels of the packet whose first, which is in the picture, is given.
FN packet_world_ray rays_through(__global const Frame* f, pixel_position first) {
    return view_ray(f, (double)first.x + (double8)(0, 1, 2, 3, 0, 1, 2, 3), (double)first.y + (double8)(0, 0, 0, 0, 1, 1, 1, 1));
}

// Those of them whose pixels are in it, too.
FN u32 rays_inside(__global const Frame* f, pixel_position first) {
    const u32 columns = f->screen.right - first.x, row = columns < PACKET_ROW ? (1u << columns) - 1u : (1u << PACKET_ROW) - 1u;
    return first.y + 1u < f->screen.bottom ? row | row << PACKET_ROW : row;
}

FN packet_slab_ray slabs_of(__global const Frame* f, packet_world_ray r) {
    return make_slab_ray(offset_from(packet_make_wide3(f->center[0], f->center[1], f->center[2]), r.o), r.d, f->radius, f->t_min);
}

// As one ray's (traversal/candidates.h), for the rays of `which`; *hit: those of them that meet the leaf.
FN u32 next_leaf(packet_slab_ray s, __global const BvhNode* nodes, u32* i, u32 end, u32 which, u32* hit) {
    u32 leaf = 0;
    while (!leaf && *i < end) {
        BvhNode node;
        // A loop of its own: what comes after a node that is missed is then loaded before it is known that it is.
        do {
            node = nodes[*i];
            *hit = bits_of(box_is_hit(s, node)) & which;
            if (!*hit) *i = node.skip;
        } while (!*hit && *i < end);
        leaf = *hit ? node.leaf : 0;
        if (*hit) {
            fetch(nodes + node.skip);
            *i = leaf ? node.skip : *i + 1;
        }
    }
    return leaf;
}

// The rays one by one.
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
