// Kernel 5: shades the first claimed partition of each ray and stores its pixel.
#include "shared/capacity.h"
#include "shared/scene_args.h"
#include "shading/pixel.h"

__kernel void shade(__global const Frame* frame, GEOMETRY_ARGS, APPEARANCE_ARGS, __global const u32* listed,
                    __global const RayCount* offsets, __global const Boundary* boundaries,
                    __global const PartitionNode* nodes, __global RayTally* tallies, __global BatchReport* report,
                    __global float* picture) {
    u32 id = (u32)get_global_id(0), seen = NONE, number;
    RayTally tally;
    Pixel pixel;
    pixel_position at;
    world_ray from_eye;
    view_range visible;
    ray3 r;
    if (id >= frame->ray_count) return;
    if (id == 0 && frame->rows) report->total = offsets[frame->ray_count];
    if (!segments_fit(frame, offsets)) return;
    number = number_of(frame, listed, id);
    at = pixel_of(number, frame->screen);
    if (!at.inside) return;
    from_eye = camera_ray(frame, at);
    visible = range_in_view(frame, from_eye);
    r = geometry_ray(frame, from_eye);
    tally = tallies[id];
    nodes += 2 * (size_t)offsets[id].segments;
    boundaries += 2 * (size_t)offsets[id].segments;
    {
        // The first claimed partition that lies in the range, in whole or in part.
        const real after = parameter_at(r, visible.after), before = parameter_at(r, visible.before);
        const u32 seen_end = frame->rank_ends[RANK_AIR];
        u32 next;
        for (next = first_partition(nodes, offsets[id + 1].segments - offsets[id].segments); next != NONE;
             next = nodes[next].next) {
            const u32 region = nodes[next].owner;
            tally.overlaps += (region & OVERLAP) != 0;
            if (seen == NONE && (region & ~OVERLAP) < seen_end && boundaries[nodes[next].out_boundary].t > after &&
                boundaries[nodes[next].in_boundary].t < before && after < before)
                seen = next;
        }
    }
    if (seen == NONE) {
        pixel = background_pixel(frame);
    } else {
        PartitionNode partition = nodes[seen];
        Boundary end = boundaries[partition.in_boundary];
        u32 region = partition.owner & ~OVERLAP;
        Geometry g = GEOMETRY;
        pixel = seen_pixel(frame, lights, materials[region], g, r, visible, end, partition.in_boundary & 1u, region);
    }
    pixel.depth = offsets[id + 1].segments - offsets[id].segments;
    pixel.partitions = tally.partitions;
    pixel.overlap = tally.overlaps;
    tallies[id].overlaps = tally.overlaps;
    put_pixel(frame, display, picture + place_of(frame, at, id), pixel);
    if (pixel.depth) mark_shown(frame, report, number);  // a ray that meets no segment sees nothing
}
