// A picture's tiles on a GPU: while one's pixels are copied, another's kernels run and a third's are queued. Each has memory of its own
// for what the host reads of it.
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
    explicit QueuedTile(Device& device) : buffers(device), answer(device, "tally") {}

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
    explicit ByLines(Device& device) : list(device), tiles{QueuedTile(device), QueuedTile(device)}, lines(device) {}

    BlockList list;
    std::array<QueuedTile, 2> tiles;
    std::size_t next = 0;        ///< of them, the one that comes next
    std::optional<Tile> ahead;   ///< what that was given already

    /// A tile that is drawn, and whose answers are on their way to the host, but not its pixels.
    struct Drawn {
        QueuedTile* tile = nullptr;
        RenderTarget target{};
        bool is_last = false;
        PipelineCounts* counts = nullptr;
    } drawn;
    PictureLines lines;

    std::uint64_t held() const { return tiles[0].buffers.held() + tiles[1].buffers.held() + lines.held(); }
    /// The next frame's first tile is the next that comes: one of a single tile always takes the same memory.
    void begin() {
        next = 0;
        ahead.reset();
        drawn = {};
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
