// Kernels: shared headers of kernels/, compiled for the host in double: the same source, the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "kernel_host/math.hpp"

namespace csgrt::kernel {

using real = double;
using wide = double;
using u32 = std::uint32_t;
inline constexpr real REAL_INFINITY = std::numeric_limits<double>::infinity();

#include "../kernels/shared/base.h"
#include "../kernels/shared/layout.h"

static_assert(sizeof(SolidRecord) == 44);
static_assert(sizeof(PlaneRecord) == 32);
static_assert(sizeof(MaterialRecord) == 32);
static_assert(sizeof(LightRecord) == 80);
static_assert(sizeof(BvhNode) == 32 && offsetof(BvhNode, high) == 16);
static_assert(sizeof(Boundary) == 16 && offsetof(Boundary, solid) == 8);
static_assert(sizeof(PartitionNode) == 16);
static_assert(sizeof(Candidate) == 16);
static_assert(sizeof(RayCount) == 8);
static_assert(sizeof(StartRecord) == 32);
static_assert(sizeof(RayTally) == sizeof(RayCount) && sizeof(CandidateCount) == sizeof(RayCount));
static_assert(sizeof(Pixel) == 52);
static_assert(sizeof(RayRecord) == 64);
static_assert(sizeof(RowBoundaries) == 12 && sizeof(OverlapRecord) == 24);
static_assert(sizeof(TileNode) == 8);
static_assert(sizeof(DeepRay) == 52);
static_assert(sizeof(DeepSegment) == 28);

}  // namespace csgrt::kernel
