#include "rays/calls.hpp"

#include <string>

#include <csgrt/error.hpp>

#include "scene/vector.hpp"

namespace csgrt {

void find_partitions(const RayList& list, Partitions& answer, Fields fields, const ListTracer& tracer) {
    RowCollector receiver(answer, fields, list.size());
    tracer.trace(list, receiver, fields.hidden ? ClaimingRegions::all : ClaimingRegions::shown);
    list.restore_lengths(answer);
}

void find_hits(const RayList& list, Hits& answer, Fields fields, const ListTracer& tracer) {
    answer.solid_ids.resize(0);
    answer.normals.resize(0);
    HitCollector receiver({.regions = &answer.region_ids,
                           .distances = &answer.t_hit,
                           .solids = fields.solids ? &answer.solid_ids : nullptr,
                           .normals = fields.normals ? &answer.normals : nullptr},
                          list.size());
    tracer.trace(list, receiver, ClaimingRegions::shown);
    list.restore_lengths(answer.t_hit);
}

void find_occluded(const RayList& list, Array<std::uint8_t>& answer, const ListTracer& tracer) {
    HitCollector receiver({.hits = &answer}, list.size());
    tracer.trace(list, receiver, ClaimingRegions::shown);
}

void find_regions(std::span<const Vec3> points, Array<std::int32_t>& answer, const ListTracer& tracer) {
    HitCollector receiver({.regions = &answer}, points.size());
    tracer.trace(RayList(points), receiver, ClaimingRegions::all);
}

// Each ray runs along a line of pixels.
void find_pixels(const Slice& slice, Array<std::int32_t>& answer, const ListTracer& tracer) {
    if (slice.width < 1 || slice.height < 1 || slice.width > 32768 || slice.height > 32768)
        throw Error(Status::usage, "the size of a slice must be 1 to 32768 pixels each way");
    const RayGrid lines{.origin = slice.center - 0.5 * slice.width * slice.right,
                        .direction = slice.right,
                        .right = {},
                        .up = slice.up,
                        .columns = 1,
                        .rows = slice.height};
    const RayList list(lines, {.all = {0, static_cast<double>(slice.width)}, .each = {}});
    PixelCollector receiver(answer, static_cast<std::uint32_t>(slice.width), list.size());
    tracer.trace(list, receiver, slice.hidden ? ClaimingRegions::all : ClaimingRegions::shown);
}

}  // namespace csgrt
