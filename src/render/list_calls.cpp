#include "render/list_calls.hpp"

#include <string>

#include <csgrt/error.hpp>

#include "scene/vector.hpp"

namespace csgrt {

void find_partitions(const RayList& list, Partitions& answer, Fields fields, const TraceList& trace) {
    RowSink sink(answer, fields, list.size());
    trace(list, sink, fields.hidden ? Claims::all : Claims::shown);
    list.restore_lengths(answer);
}

void find_hits(const RayList& list, Hits& answer, Fields fields, const TraceList& trace) {
    answer.solid_ids.resize(0);
    answer.normals.resize(0);
    HitSink sink({.regions = &answer.region_ids,
                  .distances = &answer.t_hit,
                  .solids = fields.solids ? &answer.solid_ids : nullptr,
                  .normals = fields.normals ? &answer.normals : nullptr},
                 list.size());
    trace(list, sink, Claims::shown);
    list.restore_lengths(answer.t_hit);
}

void find_occluded(const RayList& list, Array<std::uint8_t>& answer, const TraceList& trace) {
    HitSink sink({.hits = &answer}, list.size());
    trace(list, sink, Claims::shown);
}

void find_regions(std::span<const Vec3> points, Array<std::int32_t>& answer, const TraceList& trace) {
    HitSink sink({.regions = &answer}, points.size());
    trace(RayList(points), sink, Claims::all);
}

// A ray goes along the pixels of a line.
void find_pixels(const Slice& slice, Array<std::int32_t>& answer, const TraceList& trace) {
    if (slice.width < 1 || slice.height < 1 || slice.width > 32768 || slice.height > 32768)
        throw Error(Status::usage, "the size of a slice must be 1 to 32768 pixels each way");
    const RayGrid lines{.origin = slice.center - 0.5 * slice.width * slice.right,
                        .direction = slice.right,
                        .right = {},
                        .up = slice.up,
                        .columns = 1,
                        .rows = slice.height};
    const RayList list(lines, {.all = {0, static_cast<double>(slice.width)}, .each = {}});
    PixelSink sink(answer, static_cast<std::uint32_t>(slice.width), list.size());
    trace(list, sink, slice.hidden ? Claims::all : Claims::shown);
}

}  // namespace csgrt
