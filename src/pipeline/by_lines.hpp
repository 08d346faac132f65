// A picture's tiles on a GPU, two in turn: while one's kernels run, the other's are queued, or run beside them, and pixels of those
// before are copied. Each has memory of its own for all but pixels.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "device/queued.hpp"
#include "pipeline/block_list.hpp"
#include "pipeline/picture_lines.hpp"

namespace csgrt {

/// A tile that a GPU was given.
struct QueuedTile {
    QueuedTile(Device& device, std::size_t own_lane) : lane(own_lane), buffers(device), answer(device, "tally") {}

    /// The device's, of first hits: while a tile's longest rays are drawn the next one's kernels begin.
    std::size_t lane;
    kernel::Frame frame{};
    Tile tile;
    TileBuffers buffers;
    PictureLines::Lines* lines = nullptr;  ///< where it is drawn; of every partition only when it is shaded
    QueuedUpload upload;                   ///< of its frame
    QueuedRead answer;                     ///< its tally, and its blocks' bytes if they are drawn
    std::vector<Event> culled;             ///< kernel 0, the blocks' list, the background
    Event drawn;                           ///< of first hits

    const kernel::TileTally& tally() { return answer.wait<kernel::TileTally>(1).front(); }
    /// Of each block, not 0 if it shows something.
    std::span<const std::uint8_t> shown() {
        return answer.wait<std::uint8_t>(sizeof(kernel::TileTally) + tile.blocks()).subspan(sizeof(kernel::TileTally));
    }
};

/// What a pipeline has for them.
struct ByLines {
    explicit ByLines(Device& device) : list(device), tiles{QueuedTile(device, 0), QueuedTile(device, 1)}, lines(device) {}

    BlockList list;
    std::array<QueuedTile, Device::lanes> tiles;
    std::size_t next = 0;        ///< of them, the one that comes next
    std::optional<Tile> ahead;   ///< what that was given already

    /// A tile that is drawn, and whose answers are on their way to the host, but not its pixels.
    struct Drawn {
        QueuedTile* tile = nullptr;
        RenderTarget target{};
        bool is_last = false;
        PipelineCounts* counts = nullptr;
    } drawn;
    std::vector<std::uint32_t> overflown;  ///< of first hits: rays without room of tiles that are put
    PictureLines lines;

    std::uint64_t held() const {
        std::uint64_t sum = lines.held();
        for (const QueuedTile& tile : tiles) sum += tile.buffers.held();
        return sum;
    }
    /// The next frame's first tile is the next that comes: one of a single tile always takes the same memory.
    void begin() {
        next = 0;
        ahead.reset();
        drawn = {};
        overflown.clear();
    }
    /// Gives that back but for what a tile has, once the other tiles' pixels are in the picture.
    void release(const QueuedTile* but = nullptr) {
        ahead.reset();
        for (QueuedTile& tile : tiles)
            if (&tile != but) tile.buffers.release();
        lines.release(but ? but->lines : nullptr);
    }
};

}  // namespace csgrt
