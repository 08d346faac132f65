// List calls: the calls of a Model (on the caller's thread) and of a Renderer that trace lists of rays.
#pragma once

#include <cstdint>
#include <span>

#include <csgrt/partitions.hpp>

#include "rays/tracer.hpp"

namespace csgrt {

void find_partitions(const RayList& list, Partitions& answer, Fields fields, const ListTracer& tracer);
void find_hits(const RayList& list, Hits& answer, Fields fields, const ListTracer& tracer);
void find_occluded(const RayList& list, Array<std::uint8_t>& answer, const ListTracer& tracer);
void find_regions(std::span<const Vec3> points, Array<std::int32_t>& answer, const ListTracer& tracer);
void find_pixels(const Slice& slice, Array<std::int32_t>& answer, const ListTracer& tracer);

}  // namespace csgrt
