// Rows: the answer to a list for one ray. A row is made of neighbouring partitions that one region claims, and rows are
// cut at the ray's range. Kernel 6 and the reference use the same functions for rows.
#ifndef CSGRT_BOOLEAN_ROWS_H
#define CSGRT_BOOLEAN_ROWS_H

#include "../traversal/camera.h"

// A listed ray's partitions, and the row that comes next.
typedef struct {
    GLOBAL const Boundary* boundaries;
    GLOBAL const PartitionNode* nodes;
    u32 node;       // of the next partition; NONE: the list ends
    u32 first_row;  // see Frame
    wide near, far;
#ifdef CSGRT_EYE_RELATIVE
    wide start, unit;  // a distance is (start + t) / unit
#endif
} ray_rows;

// A row: the part of a ray that one region claims.
typedef struct {
    wide in, out;
    u32 in_boundary, out_boundary;  // of the ray; NONE: the range cuts the row there
    u32 region;
} ray_row;

// Begins a ray's rows. `boundaries`, `nodes`: the ray's own.
FN ray_rows rows_of(GLOBAL const Frame* f, RayRecord record, GLOBAL const Boundary* boundaries,
                    GLOBAL const PartitionNode* nodes, u32 segment_count) {
    ray_rows w;
    w.boundaries = boundaries;
    w.nodes = nodes;
    w.node = first_partition(nodes, segment_count);
    w.first_row = f->first_row;
    w.near = record.t_near;
    w.far = record.t_far;
#ifdef CSGRT_EYE_RELATIVE
    w.start = geometry_ray(f, listed_ray(record)).start;
    w.unit = unit_of(listed_ray(record));
#endif
    return w;
}

FN wide row_distance(ray_rows w, real t) {
#ifdef CSGRT_EYE_RELATIVE
    return (w.start + (wide)t) / w.unit;
#else
    (void)w;
    return t;
#endif
}

// Cuts a row at the ray's range. Returns 0 if nothing of the row is within the range. A range of one point is in the
// row that begins there, not in the row that ends there.
FN int cut_row(ray_rows w, ray_row* row) {
    const wide in = row->in, out = row->out;
    if (in < w.near) {
        row->in = w.near;
        row->in_boundary = NONE;
    }
    if (out > w.far) {
        row->out = w.far;
        row->out_boundary = NONE;
    }
    return w.near < w.far ? row->in < row->out : in <= w.near && w.near < out;
}

// Moves to the next row. 0: there is none.
FN int next_row(ray_rows* w, ray_row* row) {
    while (w->node != NONE) {
        PartitionNode last = w->nodes[w->node];
        const u32 region = last.owner & ~OVERLAP;
        int goes_on = 1;
        w->node = last.next;
        if (region == NONE) continue;
        row->region = region;
        row->in_boundary = last.in_boundary;
        while (goes_on && w->node != NONE) {
            const PartitionNode next = w->nodes[w->node];
            goes_on = (next.owner & ~OVERLAP) == region &&
                      w->boundaries[next.in_boundary].t == w->boundaries[last.out_boundary].t;
            if (goes_on) {
                last = next;
                w->node = next.next;
            }
        }
        row->out_boundary = last.out_boundary;
        row->in = row_distance(*w, w->boundaries[row->in_boundary].t);
        row->out = row_distance(*w, w->boundaries[row->out_boundary].t);
        if (cut_row(*w, row)) {
            if (w->first_row) w->node = NONE;
            return 1;
        }
    }
    return 0;
}

// Moves to the next partition that several regions of the owner's rank claim; *node is its node. 0: there is none.
FN int next_overlap(ray_rows* w, ray_row* row, u32* node) {
    while (w->node != NONE) {
        const PartitionNode n = w->nodes[w->node];
        *node = w->node;
        w->node = n.next;
        if (!(n.owner & OVERLAP)) continue;
        row->in = row_distance(*w, w->boundaries[n.in_boundary].t);
        row->out = row_distance(*w, w->boundaries[n.out_boundary].t);
        if (cut_row(*w, row)) return 1;
    }
    return 0;
}

// The normal at one boundary of a row, outward from its region. The solid's own normal is reversed where the row begins
// at the exit from a solid, and where it ends at the entry into a solid.
FN vec3 row_normal(Geometry g, ray3 r, Boundary end, u32 number, u32 is_out) {
    const vec3 n = normal_at(g, g.solids[end.solid], r, end.t, end.surface);
    return (number & 1u) == is_out ? n : make_vec3(-n.x, -n.y, -n.z);
}

#endif
