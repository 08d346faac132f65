// Batch: the rays for which the kernels run together.
#pragma once

#include <cstdint>
#include <string>

#include <csgrt/error.hpp>

#include "kernel_host/kernels.hpp"

namespace csgrt {

inline constexpr std::uint32_t tile_rays = TILE * TILE;

/// Rays [first, first + rays) of a picture, whose rays are numbered tile by tile, or of a list.
struct RayBatch {
    std::uint32_t first = 0, rays = 0;
    bool operator==(const RayBatch&) const = default;

    std::uint32_t first_tile() const { return first / tile_rays; }
    std::uint32_t end_tile() const { return (first + rays) / tile_rays; }
    std::uint32_t tiles() const { return rays / tile_rays; }
    /// False if the batch is a part of a tile, because more rays do not fit the memory.
    bool is_whole_tiles() const { return rays % tile_rays == 0; }
};

/// Throws Error (out_of_memory): even a batch of one ray does not fit.
[[noreturn]] inline void throw_too_long_ray(std::uint64_t budget) {
    throw Error(Status::out_of_memory, "the segments of one ray do not fit the device's memory (" +
                                           std::to_string(budget >> 20) +
                                           " MiB): raise --max-memory, or use --reference");
}

}  // namespace csgrt
