// Kernel 0 of a grid: makes the records of the grid's rays, so that the host need not send them. The frame of the list
// has the grid's camera.
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
