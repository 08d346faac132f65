// Solids: a packet's rays add a solid's segments to their sweeps, as boolean/first_hit.h does for one ray. Closed-form
// solids are intersected with all rays at once.
//
// A mask is a word whose bit k stands for ray k: the active mask for the rays that take part, the overflow mask for the
// rays whose sweep has no free slot for another segment.
#ifndef CSGRT_PACKET_SOLIDS_H
#define CSGRT_PACKET_SOLIDS_H

#include "../boolean/first_hit.h"
#include "packet.h"

// The meaning of a ray's parameter t: claims up to `after` are not seen, boundaries within `tolerance` are one event,
// and unit x t - offset is the distance in the list of nodes.
typedef struct {
    real after, tolerance;
    wide unit, per_unit, offset;  // per_unit: 1 / unit
} sweep_units;

// The state of a packet's rays during the search for their first hits.
typedef struct {
    packet_ray3 rays;
    packet_lanes lanes;
    packet_slab_ray slabs;
    double8 t_min;              // segments that end before it are not wanted
    packet_view_range range;    // of a picture's rays
    sweep_units units[PACKET];  // one a ray
    float next_events[PACKET];  // one a sweep, from next_event_of()
    sweep sweeps[PACKET];
} packet;

// An estimate of the distance where the next event of ray k is complete, in the distances of the list.
FN float next_event_of(const packet* p, u32 k) {
    const sweep* w = p->sweeps + k;
    const sweep_units r = p->units[k];
    return w->next_event < REAL_INFINITY ? (float)((wide)(w->next_event + r.tolerance) * r.unit - r.offset)
                                         : BOX_MISSED;
}

// Adds a solid's segments to the active rays' sweeps. Returns the overflow mask.
FN u32 take_solid_by_packet(packet* p, Geometry g, u32 index, u32 active_mask) {
    const SolidRecord solid = g.solids[index];
    u32 alone = active_mask, overflow_mask = 0;
    real t_min[PACKET];
    vstore8(p->t_min, 0, t_min);
    if ((active_mask & (active_mask - 1u)) && takes_packets(solid)) {
        const packet_segments h = packet_intersect(g, solid, p->rays);
        u32 found = bits_of(h.count == 1 && h.out0 >= p->t_min) & active_mask;
        alone &= bits_of(h.count == UNDECIDED);
        if (found) {
            real in[PACKET], out[PACKET];
            ulong in_surface[PACKET], out_surface[PACKET];
            vstore8(h.in0, 0, in);
            vstore8(h.out0, 0, out);
            vstore8(h.in0_surface, 0, in_surface);
            vstore8(h.out0_surface, 0, out_surface);
            for (; found; found &= found - 1u) {
                const u32 k = lowest(found);
                Boundary boundaries[2];
                put_segment(boundaries, index, in[k], (u32)in_surface[k], out[k], (u32)out_surface[k]);
                if (!take_segment(p->sweeps + k, solid, boundaries[0], boundaries[1])) overflow_mask |= 1u << k;
                p->next_events[k] = next_event_of(p, k);
            }
        }
    }
    for (; alone; alone &= alone - 1u) {
        const u32 k = lowest(alone);
        if (!take_solid(p->sweeps + k, g, index, lane(&p->lanes, k), t_min[k])) overflow_mask |= 1u << k;
        p->next_events[k] = next_event_of(p, k);
    }
    return overflow_mask;
}

#endif
