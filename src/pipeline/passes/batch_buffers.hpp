// One batch on the device.
#pragma once

#include <cstdint>

#include "device/program.hpp"
#include "pipeline/batch.hpp"

namespace csgrt {

/// Which rays a batch's kernels are run for, and in which buffer they are listed: tiles of a picture, single pixels of
/// it, or rays as they were given.
enum class Work : std::uint32_t { tiles = WORK_TILES, pixels = WORK_PIXELS, rays = WORK_RAYS };

struct BatchBuffers {
    explicit BatchBuffers(Device& device)
        : frame(device, "frame"),
          costs(device, "tiles' costs"),
          tile_nodes(device, "tiles' nodes"),
          tiles(device, "list of tiles"),
          pixels(device, "list of pixels"),
          rays(device, "list of rays"),
          report(device, "report"),
          overflown(device, "rays that overflowed") {}

    Buffer frame;       ///< kernel::Frame in the program's precision
    Buffer costs;       ///< of each tile a byte: kernel 0's estimate of its cost, 0 if its rays see nothing
    Buffer tile_nodes;  ///< of each tile LISTED_NODES kernel::TileNode
    Buffer tiles;       ///< Work::tiles: their numbers, on a GPU with the number of a part (PART_SHIFT)
    Buffer pixels;      ///< Work::pixels: the numbers of their rays
    Buffer rays;        ///< Work::rays: kernel::RayRecord in the program's precision
    Buffer report;      ///< kernel::BatchReport, and of each tile a byte: not 0 if it shows something
    Buffer overflown;   ///< first hits: the numbers of rays that had no place for all their segments

    /// Kernels' list of tiles or of pixels; nothing for rays as they were given.
    const Buffer& numbers(Work work) const { return work == Work::pixels ? pixels : tiles; }

    static std::uint64_t report_bytes(const RayBatch& batch) {
        return sizeof(kernel::BatchReport) + (std::uint64_t{batch.tiles()} + 3) / 4 * 4;
    }
    std::uint64_t held() const {
        std::uint64_t sum = 0;
        for (const Buffer* buffer : {&costs, &tile_nodes, &tiles, &pixels, &rays, &report, &overflown})
            sum += buffer->size();
        return sum;
    }
    /// Gives the memory back.
    void release() {
        costs.release();
        tile_nodes.release();
        release_lists();
    }
    /// The same, but for what kernel 0 wrote.
    void release_lists() {
        for (Buffer* buffer : {&tiles, &pixels, &rays, &report, &overflown}) buffer->release();
    }
};

}  // namespace csgrt
