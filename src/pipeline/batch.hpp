// A batch: the rays that go through the kernels together.
#pragma once

#include <cstdint>

#include "kernel_host/kernels.hpp"

namespace csgrt {

inline constexpr std::uint32_t tile_rays = TILE * TILE;

/// Rays [first, first + rays) of a picture, which are numbered tile by tile, or of a list.
struct RayBatch {
    std::uint32_t first = 0, rays = 0;
    bool operator==(const RayBatch&) const = default;

    std::uint32_t first_tile() const { return first / tile_rays; }
    std::uint32_t end_tile() const { return (first + rays) / tile_rays; }
    std::uint32_t tiles() const { return rays / tile_rays; }
    /// False: it is a part of a tile, because the memory holds no more.
    bool is_whole_tiles() const { return rays % tile_rays == 0; }
};

}  // namespace csgrt
