// Begin: opens the second compilation of some kernel headers, for a packet of eight rays side by side. packet/end.h
// closes it. packet/packet.h includes between the two the headers that are compiled twice.
//
// How it works. The headers are written for one ray: its numbers are `real`, `single` and so on, and structs of these.
// This file redefines the names of these types as vectors of eight, of which lane k is ray k. It gives other names to
// the structs that hold them, and lifts the guards of the headers, so that the next inclusion compiles each header once
// more. Functions keep their names: OpenCL C overloads them by the types of their arguments (FN in shared/base.h).
// Functions whose arguments are the same both times get other names here.
//
// Why the bits are the same. The source is the same, so each lane goes through the same operations in the same order as
// one ray does. IEEE 754 rounds an operation in each lane of a vector as it rounds it on scalars. The compiler
// contracts nothing. A lane may compute numbers that its ray has no use for, and NaNs; no lane reads another lane's
// numbers.
//
// Rules of a header that is compiled twice:
// - The types of shared/base.h say what a value belongs to. real, wide, single, tag and lane masks belong to a ray;
//   parameter, u32, int and float are the same for all rays.
// - A comparison of rays' values gives a lane_mask. It is 1 or 0 for one ray, and -1 or 0 in a lane, so nothing is
//   calculated with it. It selects by ?:, and && || ! combine it. On vectors && and || evaluate both sides.
// - `if`, `return` and loops depend on values that are the same for all rays, or on no_lane(mask), to leave out work
//   that no ray needs.
// - A constant beside rays' values in ?: is written REAL(x), SINGLE(x) or TAG(x). sizeof(real) is the vector's size;
//   BY_PRECISION uses the size of one number.
// - Each new type that holds rays' values, each function that overloading cannot tell apart, and each header's guard is
//   listed here, and the names also in end.h.
#ifndef CSGRT_PACKET_BEGIN_H
#define CSGRT_PACKET_BEGIN_H

// The types of shared/base.h.
#define real double8
#define wide double8
#define single float8
#define lane_mask long8
#define single_lane_mask int8
#define tag ulong8

// Structs of the types above.
#define vec3 packet_vec3
#define wide3 packet_wide3
#define pair packet_pair
#define offset3 packet_offset3
#define world_ray packet_world_ray
#define view_range packet_view_range
#define ray3 packet_ray3
#define slab_ray packet_slab_ray
#define segments packet_segments
#define span packet_span
#define local_ray packet_local_ray
#define quadratic packet_quadratic
#define tor_piece packet_tor_piece
#define sight packet_sight
#define finish packet_finish
#define rgb packet_rgb

// Functions whose arguments are the same both times.
#define make_vec3 packet_make_vec3
#define make_wide3 packet_make_wide3
#define no_segments packet_no_segments
#define whole_line packet_whole_line
#define plane_normal packet_plane_normal
#define face_normal packet_face_normal

// The headers that are compiled once more.
#undef CSGRT_SHARED_VECTORS_H
#undef CSGRT_SHARED_SLAB_H
#undef CSGRT_TRAVERSAL_VIEW_H
#undef CSGRT_GEOMETRY_SEGMENTS_H
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
#undef CSGRT_GEOMETRY_CLOSED_FORM_H
#undef CSGRT_SHADING_PLASTIC_H

#endif
