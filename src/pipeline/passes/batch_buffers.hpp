// Batch buffers: the memory of one batch on the device.
#pragma once

#include <cstdint>

#include "device/program.hpp"
#include "pipeline/batch.hpp"

namespace csgrt {

/// The kind of a batch's rays, which decides the buffer that lists them: tiles of a picture, single pixels of a
/// picture, or the rays of a list.
enum class Work : std::uint32_t { tiles = WORK_TILES, pixels = WORK_PIXELS, rays = WORK_RAYS };

/// The buffers of one batch that several passes share: its frame, its list of tiles, pixels or rays, and its report.
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
    Buffer costs;       ///< one byte a tile: kernel 0's estimate of its cost; 0: its rays see nothing
    Buffer tile_nodes;  ///< LISTED_NODES kernel::TileNode a tile
    Buffer tiles;       ///< Work::tiles: the tiles' numbers, on a GPU with the number of a part (PART_SHIFT)
    Buffer pixels;      ///< Work::pixels: the numbers of the pixels' rays
    Buffer rays;        ///< Work::rays: kernel::RayRecord in the program's precision
    Buffer report;      ///< kernel::BatchReport, and one byte a tile: not 0 if the tile shows something
    Buffer overflown;   ///< first hits: the numbers of rays with too many segments at a time

    /// The kernels' list of tiles or of pixels; it has no meaning for the rays of a list.
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
    /// Gives the memory back, except the buffers that kernel 0 wrote.
    void release_lists() {
        for (Buffer* buffer : {&tiles, &pixels, &rays, &report, &overflown}) buffer->release();
    }
};

}  // namespace csgrt
