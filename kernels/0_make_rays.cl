// The records of a grid's rays, which the host need not send: the camera of the list's frame has them.
#include "traversal/camera.h"

__kernel void make_rays(__global const Frame* frame, wide t_near, wide t_far, __global RayRecord* rays) {
    const u32 id = (u32)get_global_id(0), number = frame->first_ray + id;
    world_ray r;
    RayRecord record;
    if (id >= frame->ray_count) return;
    r = view_ray(frame, (wide)(number % frame->width), (wide)(number / frame->width));
    record.ox = r.o.x;
    record.oy = r.o.y;
    record.oz = r.o.z;
    record.dx = r.d.x;
    record.dy = r.d.y;
    record.dz = r.d.z;
    record.t_near = t_near;
    record.t_far = t_far;
    rays[id] = record;
}
