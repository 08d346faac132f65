// A picture's tiles on a GPU, two under way: while one's kernels run, the other's are queued, or run beside them, and pixels of those
// before are copied. Each has memory of its own for all but pixels, segments and partitions.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "device/queued.hpp"
#include "pipeline/block_list.hpp"
#include "pipeline/exact.hpp"
#include "pipeline/picture_lines.hpp"

namespace csgrt {

/// A tile that a GPU was given.
struct QueuedTile {
    explicit QueuedTile(Device& device) : buffers(device), answer(device, "tally") {}

    bool is_under_way = false;  ///< given, and not put or given up yet
    kernel::Frame frame{};
    Tile tile;
    TileBuffers buffers;
    PictureLines::Lines* lines = nullptr;  ///< where it is drawn; of every partition only when it is shaded
    QueuedUpload upload;                   ///< of its frame
    QueuedRead answer;                     ///< its tally, and its blocks' bytes if they are drawn
    std::vector<Event> culled;             ///< kernel 0, the blocks' list, the background
    TimedKernels kernels;                  ///< that draw
    Exact::Needs room;                     ///< of those, of every partition

    const kernel::TileTally& tally() { return answer.wait<kernel::TileTally>(1).front(); }
    /// Of each block, not 0 if it shows something.
    std::span<const std::uint8_t> shown() {
        return answer.wait<std::uint8_t>(sizeof(kernel::TileTally) + tile.blocks()).subspan(sizeof(kernel::TileTally));
    }
};

/// What a pipeline has for them.
struct ByLines {
    explicit ByLines(Device& device) : list(device), tiles{QueuedTile(device), QueuedTile(device)}, lines(device) {}

    BlockList list;
    /// As many as the device has lanes: of first hits each has its own, so that while a tile's longest rays are drawn the next ones'
    /// kernels begin.
    std::array<QueuedTile, Device::lanes> tiles;
    std::vector<std::uint32_t> overflown;  ///< of first hits: rays without room of tiles that are put
    PictureLines lines;

    /// The first that is not under way: a frame of a single tile always takes the same memory. Null: all are.
    QueuedTile* free_tile() {
        const auto free = std::ranges::find(tiles, false, &QueuedTile::is_under_way);
        return free == tiles.end() ? nullptr : &*free;
    }
    std::size_t lane_of(const QueuedTile& tile) const { return static_cast<std::size_t>(&tile - tiles.data()); }

    std::uint64_t held() const {
        std::uint64_t sum = lines.held();
        for (const QueuedTile& tile : tiles) sum += tile.buffers.held();
        return sum;
    }
    /// No tile is under way any more.
    void give_up() {
        for (QueuedTile& tile : tiles) tile.is_under_way = false;
        overflown.clear();
    }
    /// Gives that back but for what a tile has, once the pixels of others are in the picture.
    void release(const QueuedTile* but = nullptr) {
        for (QueuedTile& tile : tiles)
            if (&tile != but) tile.buffers.release();
        lines.release(but ? but->lines : nullptr);
    }
};

}  // namespace csgrt
