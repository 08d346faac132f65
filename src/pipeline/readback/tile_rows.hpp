// Where a batch's tiles are in the picture: rows of the screen's, the first and the last of which may be parts of rows.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

#include "pipeline/readback/picture.hpp"

namespace csgrt {

/// The first byte from `begin` on that is not 0, or `end`: eight are looked at at once.
inline std::size_t next_covered(std::span<const std::uint8_t> bytes, std::size_t begin, std::size_t end) {
    for (; begin + 8 <= end; begin += 8) {
        std::uint64_t eight = 0;
        std::memcpy(&eight, bytes.data() + begin, sizeof eight);
        if (eight != 0) break;
    }
    while (begin < end && bytes[begin] == 0) ++begin;
    return begin;
}

/// How many bytes, each 0 or 1, are 1.
inline std::size_t count_covered(std::span<const std::uint8_t> bytes) {
    std::size_t count = 0, i = 0;
    for (; i + 8 <= bytes.size(); i += 8) {
        std::uint64_t eight = 0;
        std::memcpy(&eight, bytes.data() + i, sizeof eight);
        count += static_cast<std::size_t>(std::popcount(eight));
    }
    for (; i < bytes.size(); ++i) count += bytes[i];
    return count;
}

class TileRows {
public:
    /// Tiles of a row, begin ... end - 1, from the screen's left edge.
    struct Extent {
        std::size_t begin = 0, end = 0;
        bool is_empty() const { return begin == end; }
    };

    /// The screen's tiles from number `first` to `end`.
    TileRows(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end)
        : screen_(frame.screen),
          across_(kernel::tiles_across(screen_)),
          picture_across_((frame.width + TILE - 1) / TILE),
          first_(first),
          end_(end),
          first_row_(first / across_),
          count_((end + across_ - 1) / across_ - first_row_) {}

    std::size_t count() const { return count_; }
    Extent whole(std::size_t row) const {
        const std::size_t start = (first_row_ + row) * across_;
        return {std::max(first_, start) - start, std::min(end_, start + across_) - start};
    }
    /// A tile's place among the batch's.
    std::size_t place(std::size_t row, std::size_t tile) const { return (first_row_ + row) * across_ + tile - first_; }
    /// The target's account of a row: not 0 for tiles that hold anything but background.
    std::span<std::uint8_t> covered(std::size_t row, const RenderTarget& target) const {
        const Extent all = whole(row);
        return target.covered.subspan(
            (screen_.top / TILE + first_row_ + row) * picture_across_ + screen_.left / TILE + all.begin,
            all.end - all.begin);
    }

    /// The picture's column that a tile of the screen begins with, and the line that a row does.
    std::size_t column(std::size_t tile) const {
        return std::min<std::size_t>(screen_.left + tile * TILE, screen_.right);
    }
    std::size_t top(std::size_t row) const {
        return std::min<std::size_t>(screen_.top + (first_row_ + row) * TILE, screen_.bottom);
    }
    std::size_t row_of(std::size_t line) const { return (line - screen_.top) / TILE - first_row_; }

private:
    kernel::ScreenBounds screen_;
    std::size_t across_, picture_across_, first_, end_, first_row_, count_;
};

}  // namespace csgrt
