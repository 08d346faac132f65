// What is asked of lists of rays: the calls of a Model, on the caller's thread, and a Renderer's.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include <csgrt/partitions.hpp>

#include "compile/lists/ray_list.hpp"
#include "compile/lists/sink.hpp"

namespace csgrt {

/// Which regions claim partitions: all; those that pictures show; or the ghosts alone.
enum class Claims { all, shown, ghosts };

/// Puts the rows of a list.
using TraceList = std::function<void(const RayList&, RowTaker&, Claims)>;

void find_partitions(const RayList& list, Partitions& answer, Fields fields, const TraceList& trace);
void find_hits(const RayList& list, Hits& answer, Fields fields, const TraceList& trace);
void find_occluded(const RayList& list, Array<std::uint8_t>& answer, const TraceList& trace);
void find_regions(std::span<const Vec3> points, Array<std::int32_t>& answer, const TraceList& trace);
void find_pixels(const Slice& slice, Array<std::int32_t>& answer, const TraceList& trace);

}  // namespace csgrt
