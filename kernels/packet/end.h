// End: closes the section that packet/begin.h opens. Each name means one ray's type or function again.
#ifndef CSGRT_PACKET_END_H
#define CSGRT_PACKET_END_H

#undef real
#undef wide
#undef single
#undef lane_mask
#undef single_lane_mask
#undef tag
#undef vec3
#undef wide3
#undef pair
#undef offset3
#undef world_ray
#undef view_range
#undef ray3
#undef slab_ray
#undef segments
#undef span
#undef local_ray
#undef quadratic
#undef tor_piece
#undef sight
#undef finish
#undef rgb
#undef make_vec3
#undef make_wide3
#undef no_segments
#undef whole_line
#undef plane_normal
#undef face_normal

#endif
