// List calls: the calls of a Model, on the caller's thread, and of a Renderer that are answered by lists of rays.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include <csgrt/partitions.hpp>

#include "compile/lists/ray_list.hpp"
#include "compile/lists/row_receivers.hpp"

namespace csgrt {

/// The regions that claim partitions: all; those that pictures show; or only the ghosts.
enum class ClaimingRegions { all, shown, ghosts };

/// Traces a list and puts its rows into the receiver.
using TraceList = std::function<void(const RayList&, RowReceiver&, ClaimingRegions)>;

void find_partitions(const RayList& list, Partitions& answer, Fields fields, const TraceList& trace);
void find_hits(const RayList& list, Hits& answer, Fields fields, const TraceList& trace);
void find_occluded(const RayList& list, Array<std::uint8_t>& answer, const TraceList& trace);
void find_regions(std::span<const Vec3> points, Array<std::int32_t>& answer, const TraceList& trace);
void find_pixels(const Slice& slice, Array<std::int32_t>& answer, const TraceList& trace);

}  // namespace csgrt
