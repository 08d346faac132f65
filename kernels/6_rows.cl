// Kernel 6: writes the answers to a list of rays as arrays. A row is a partition that a region claims. The rows of a
// ray are stored together, in order of distance.
//
//   count rows -> (scan) -> write rows -> describe rows
//                                      -> count claimants -> (scan) -> list claimants
//
// Each array is optional: its argument is 0 if the caller does not want the array.
#include "shared/scene_args.h"
#include "geometry/solid.h"
#include "boolean/claimants.h"
#include "boolean/rows.h"

static ray_rows rows_at(__global const Frame* frame, __global const RayRecord* rays, u32 ray,
                        __global const RayCount* offsets, __global const Boundary* boundaries,
                        __global const PartitionNode* nodes) {
    const u32 first = offsets[ray].segments;
    return rows_of(frame, rays[ray], boundaries + 2 * (size_t)first, nodes + 2 * (size_t)first,
                   offsets[ray + 1].segments - first);
}

// Counts a ray's rows in counts.segments, and its partitions that overlap in counts.words.
__kernel void count_rows(__global const Frame* frame, __global const RayRecord* rays, __global const RayCount* offsets,
                         __global const Boundary* boundaries, __global const PartitionNode* nodes,
                         __global RayCount* counts) {
    const u32 id = (u32)get_global_id(0);
    RayCount count;
    ray_rows rows, overlaps;
    ray_row row;
    u32 node;
    if (id >= frame->ray_count) return;
    count.segments = count.words = 0;
    rows = overlaps = rows_at(frame, rays, id, offsets, boundaries, nodes);
    while (next_row(&rows, &row)) ++count.segments;
    while (next_overlap(&overlaps, &row, &node)) ++count.words;
    counts[id] = count;
}

__kernel void write_rows(__global const Frame* frame, __global const RayRecord* rays, __global const RayCount* offsets,
                         __global const Boundary* boundaries, __global const PartitionNode* nodes,
                         __global const RayCount* places, __global int* regions, __global wide* in, __global wide* out,
                         __global RowBoundaries* bounds, __global OverlapRecord* overlap_records) {
    const u32 id = (u32)get_global_id(0);
    ray_rows rows, overlaps;
    ray_row row;
    RayCount place;
    u32 base;
    if (id >= frame->ray_count) return;
    place = places[id];
    rows = overlaps = rows_at(frame, rays, id, offsets, boundaries, nodes);
    base = 2 * offsets[id].segments;
    for (; next_row(&rows, &row); ++place.segments) {
        regions[place.segments] = (int)row.region;
        in[place.segments] = row.in;
        out[place.segments] = row.out;
        if (bounds) {
            RowBoundaries b;
            b.ray = id;
            b.in_boundary = row.in_boundary == NONE ? NONE : base + row.in_boundary;
            b.out_boundary = row.out_boundary == NONE ? NONE : base + row.out_boundary;
            bounds[place.segments] = b;
        }
    }
    if (overlap_records) {
        OverlapRecord overlap_record;
        for (; next_overlap(&overlaps, &row, &overlap_record.node); ++place.words) {
            overlap_record.ray = id;
            overlap_record.in = row.in;
            overlap_record.out = row.out;
            overlap_records[place.words] = overlap_record;
        }
    }
}

// Describes one boundary of a row: the solid whose surface it is, and the normal; -1 and a zero vector where the range
// cuts the row.
static void describe_boundary(__global const Frame* frame, Geometry g, __global const RayRecord* rays,
                              __global const Boundary* boundaries, u32 ray, u32 number, u32 is_out, size_t place,
                              __global int* solids, __global wide* normals) {
    vec3 n = make_vec3(0, 0, 0);
    int solid = -1;
    if (number != NONE) {
        const Boundary end = boundaries[number];
        solid = (int)end.solid;
        if (normals) n = row_normal(g, geometry_ray(frame, listed_ray(rays[ray])), end, number, is_out);
    }
    if (solids) solids[place] = solid;
    if (normals) {
        normals[3 * place] = n.x;
        normals[3 * place + 1] = n.y;
        normals[3 * place + 2] = n.z;
    }
}

// Describes one row a work-item. `bounds`: the output of write_rows.
__kernel void describe_rows(__global const Frame* frame, GEOMETRY_ARGS, __global const RayRecord* rays,
                            __global const Boundary* boundaries, __global const RowBoundaries* bounds, u32 rows,
                            __global int* in_solids, __global int* out_solids, __global wide* in_normals,
                            __global wide* out_normals) {
    const u32 id = (u32)get_global_id(0);
    const Geometry g = GEOMETRY;
    RowBoundaries b;
    if (id >= rows) return;
    b = bounds[id];
    describe_boundary(frame, g, rays, boundaries, b.ray, b.in_boundary, 0, id, in_solids, in_normals);
    describe_boundary(frame, g, rays, boundaries, b.ray, b.out_boundary, 1, id, out_solids, out_normals);
}

// Whether the ray of an overlap is deep. Kernel 4 did not evaluate its partitions; the host lists their claimants.
static int has_deep_ray(OverlapRecord overlap_record, __global const RayCount* offsets) {
    return offsets[overlap_record.ray + 1].segments - offsets[overlap_record.ray].segments > DEEP_SEGMENTS;
}

// The cover of an overlap's partition, whose ray is not deep.
static cover cover_of(OverlapRecord overlap_record, __global const SolidRecord* solids, REGION_ARGS,
                      __global const RayCount* offsets, __global const Boundary* boundaries, __global const u32* bits) {
    const RayCount offset = offsets[overlap_record.ray];
    cover c;
    c.segments = offsets[overlap_record.ray + 1].segments - offset.segments;
    c.boundaries = boundaries + 2 * (size_t)offset.segments;
    c.bits = bits + offset.words + overlap_record.node * words_of(c.segments);
    c.missed = c.beyond = 0;
    c.marked = 1;
    c.solids = solids;
    c.starts = starts;
    c.trees = trees;
    return c;
}

// Counts the claims for which list_claimants needs memory, one record a work-item. Deep rays have none.
__kernel void count_claimants(EVALUATION_ARGS, __global const RayCount* offsets, __global const Boundary* boundaries,
                              __global const u32* bits, __global const OverlapRecord* overlap_records,
                              u32 overlap_count, __global RayCount* places) {
    const u32 id = (u32)get_global_id(0);
    RayCount count;
    if (id >= overlap_count) return;
    count.words = count.segments = 0;
    if (!has_deep_ray(overlap_records[id], offsets))
        count.segments =
            claims_at_most(cover_of(overlap_records[id], solids, starts, trees, offsets, boundaries, bits));
    places[id] = count;
}

__kernel void list_claimants(__global const Frame* frame, EVALUATION_ARGS, __global const RayCount* offsets,
                             __global const Boundary* boundaries, __global const u32* bits,
                             __global const OverlapRecord* overlap_records, u32 overlap_count,
                             __global const RayCount* places, __global u32* claimants, __global u32* counts) {
    const u32 id = (u32)get_global_id(0);
    if (id >= overlap_count) return;
    counts[id] = 0;
    if (has_deep_ray(overlap_records[id], offsets)) return;
    counts[id] = all_claimants(cover_of(overlap_records[id], solids, starts, trees, offsets, boundaries, bits),
                               frame->rank_ends, claimants + places[id].segments);
}
