// Opens the second compilation of some kernel headers: for a packet of eight rays side by side. packet/end.h closes
// it, and what packet/packet.h includes in between is what is compiled twice.
//
// How it works. The headers are written for one ray: its numbers are `real`, `single` and so on, and structs of
// these. Here those names become vectors of eight (lane k is ray k), the structs that hold them get names of their
// own, and the guards of the headers are lifted, so that the next #include of each compiles it once more. Functions
// keep their names: OpenCL C overloads them by the types of their arguments (FN in shared/base.h). Only those whose
// arguments are the same both times are renamed.
//
// Why the bits are the same. It is the same source, so each lane goes through the same operations in the same order;
// IEEE 754 rounds an operation on vectors lane by lane as it rounds one on scalars; and nothing is contracted. A lane
// may compute numbers that its ray has no use for, and NaNs: no lane sees another's.
//
// What a header must keep to, to be compiled twice:
// - The types of shared/base.h say what a value belongs to. To a ray: real, wide, single, tag, and lane masks. To the
//   scene, the same for all rays: parameter, u32, int, float.
// - A comparison of rays' values is a lane_mask: 1 of one ray, but -1 in a lane. It chooses with ?: and is joined
//   with && || ! (which leave nothing out in vectors), and is not calculated with.
// - `if`, `return` and loops depend on what is the same for all rays, or on none(mask): work that no ray needs may be
//   left out.
// - Constants that stand beside rays' values in ?: are written REAL(x), SINGLE(x) or TAG(x). `sizeof(real)` is that
//   of a vector: BY_PRECISION knows how many digits a ray's number has.
// - A new type that holds rays' values, a function whose arguments do not, and each header's guard are listed here;
//   the names in end.h, too.
#ifndef CSGRT_PACKET_BEGIN_H
#define CSGRT_PACKET_BEGIN_H

// What shared/base.h calls these of one ray.
#define real double8
#define wide double8
#define single float8
#define lane_mask long8
#define single_lane_mask int8
#define tag ulong8

// Types of them.
#define vec3 packet_vec3
#define wide3 packet_wide3
#define pair packet_pair
#define offset3 packet_offset3
#define world_ray packet_world_ray
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

// Functions whose arguments do not tell the two kinds apart.
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
#undef CSGRT_SHADING_PLASTIC_H

#endif
