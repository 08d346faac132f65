// Where a tile's blocks are in the picture: rows of the window's, the first and the last of which may be parts of rows.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

#include "pipeline/picture.hpp"

namespace csgrt {

/// The first byte from `begin` on that is not 0, or `end`: eight are looked at at once.
inline std::size_t next_held(std::span<const std::uint8_t> bytes, std::size_t begin, std::size_t end) {
    for (; begin + 8 <= end; begin += 8) {
        std::uint64_t eight = 0;
        std::memcpy(&eight, bytes.data() + begin, sizeof eight);
        if (eight != 0) break;
    }
    while (begin < end && bytes[begin] == 0) ++begin;
    return begin;
}

/// How many bytes, each 0 or 1, are 1.
inline std::size_t count_held(std::span<const std::uint8_t> bytes) {
    std::size_t count = 0, i = 0;
    for (; i + 8 <= bytes.size(); i += 8) {
        std::uint64_t eight = 0;
        std::memcpy(&eight, bytes.data() + i, sizeof eight);
        count += static_cast<std::size_t>(std::popcount(eight));
    }
    for (; i < bytes.size(); ++i) count += bytes[i];
    return count;
}

class BlockRows {
public:
    /// Blocks of a row, begin ... end - 1, from the window's left edge.
    struct Extent {
        std::size_t begin = 0, end = 0;
        bool is_empty() const { return begin == end; }
    };

    /// The window's blocks from number `first` to `end`.
    BlockRows(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end)
        : window_(frame.window), across_(kernel::blocks_across(window_)), picture_across_((frame.width + BLOCK - 1) / BLOCK),
          first_(first), end_(end), first_row_(first / across_), count_((end + across_ - 1) / across_ - first_row_) {}

    std::size_t count() const { return count_; }
    Extent whole(std::size_t row) const {
        const std::size_t start = (first_row_ + row) * across_;
        return {std::max(first_, start) - start, std::min(end_, start + across_) - start};
    }
    /// A block's place among the tile's.
    std::size_t place(std::size_t row, std::size_t block) const { return (first_row_ + row) * across_ + block - first_; }
    /// The target's account of a row: not 0 for blocks that hold anything but background.
    std::span<std::uint8_t> held(std::size_t row, const RenderTarget& target) const {
        const Extent all = whole(row);
        return target.drawn.subspan((window_.top / BLOCK + first_row_ + row) * picture_across_ + window_.left / BLOCK + all.begin,
                                    all.end - all.begin);
    }

    /// The picture's column that a block of the window begins with, and the line that a row does.
    std::size_t column(std::size_t block) const { return std::min<std::size_t>(window_.left + block * BLOCK, window_.right); }
    std::size_t top(std::size_t row) const {
        return std::min<std::size_t>(window_.top + (first_row_ + row) * BLOCK, window_.bottom);
    }
    std::size_t row_of(std::size_t line) const { return (line - window_.top) / BLOCK - first_row_; }

private:
    kernel::Window window_;
    std::size_t across_, picture_across_, first_, end_, first_row_, count_;
};

}  // namespace csgrt
