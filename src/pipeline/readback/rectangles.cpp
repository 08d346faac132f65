#include "pipeline/readback/rectangles.hpp"

#include <algorithm>
#include <cstring>

#include "pipeline/readback/tile_rows.hpp"

namespace csgrt {
namespace {

/// Of bytes, the first of which is tile `left`'s, from the first to the last that is not 0: eight at a time.
TileRows::Extent extent_of(std::span<const std::uint8_t> bytes, std::size_t left) {
    const auto are_zero = [&](std::size_t at) {
        std::uint64_t eight = 0;
        std::memcpy(&eight, bytes.data() + at, sizeof eight);
        return eight == 0;
    };
    std::size_t end = bytes.size();
    const std::size_t begin = next_covered(bytes, 0, end);
    while (end >= begin + 8 && are_zero(end - 8)) end -= 8;
    while (end > begin && bytes[end - 1] == 0) --end;
    return begin == end ? TileRows::Extent{} : TileRows::Extent{left + begin, left + end};
}

/// A row's pixels; where there is room beside them, whole lines of the processor's cache, the first of which begins
/// with pixel `aligned`: a GPU writes those a quarter sooner (docs/experiments/gpu-frames.md).
Rectangle pixels_of(const TileRows& rows, std::size_t row, TileRows::Extent extent, std::size_t aligned) {
    constexpr std::size_t line = 64 / sizeof(float);
    const TileRows::Extent all = rows.whole(row);
    std::size_t left = rows.column(extent.begin), right = rows.column(extent.end);
    const std::size_t before = (left + line - aligned) % line, behind = (aligned + line - right % line) % line;
    if (left >= rows.column(all.begin) + before) left -= before;
    if (right + behind <= rows.column(all.end)) right += behind;
    return {left, right, rows.top(row), rows.top(row + 1)};
}

/// Whether all of it is the batch's, whose rows but the first and the last are whole.
bool hold(const TileRows& rows, const Rectangle& r) {
    const auto fits = [&](std::size_t line) {
        const TileRows::Extent all = rows.whole(rows.row_of(line));
        return r.left >= rows.column(all.begin) && r.right <= rows.column(all.end);
    };
    return fits(r.top) && fits(r.bottom - 1);
}

constexpr std::size_t copy_cost =
    1 << 12;  // pixels that a copy's begin takes as long as (docs/experiments/gpu-frames.md)

/// Of rows that follow each other, what is between two columns of tiles.
struct Part {
    std::size_t first_row, end_row;
    TileRows::Extent columns;
    Rectangle pixels;
};

Part around(const Part& a, const Part& b) {
    return {std::min(a.first_row, b.first_row),
            std::max(a.end_row, b.end_row),
            {std::min(a.columns.begin, b.columns.begin), std::max(a.columns.end, b.columns.end)},
            {std::min(a.pixels.left, b.pixels.left), std::max(a.pixels.right, b.pixels.right),
             std::min(a.pixels.top, b.pixels.top), std::max(a.pixels.bottom, b.pixels.bottom)}};
}

/// The batch's tiles that are needed, and what holds them.
class Needed {
public:
    Needed(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::span<const std::uint8_t> shown,
           const RenderTarget& target)
        : rows_(frame, first, end), across_(kernel::tiles_across(frame.screen)), tiles_(rows_.count() * across_) {
        const std::size_t behind =
            reinterpret_cast<std::uintptr_t>(target.channels.front().pixels) % 64 / sizeof(float);
        aligned_ = (16 - behind) % 16;
        for (std::size_t row = 0; row < rows_.count(); ++row) {
            const TileRows::Extent all = rows_.whole(row);
            const std::uint8_t *own = shown.data() + rows_.place(row, all.begin),
                               *covered = rows_.covered(row, target).data();
            std::uint8_t* const needed = tiles_.data() + row * across_ + all.begin;
            for (std::size_t i = 0; i < all.end - all.begin; ++i) needed[i] = own[i] | covered[i];
        }
    }

    std::vector<Rectangle> rectangles() const { return cover(0, rows_.count(), {0, across_}); }

private:
    /// Those of some rows, between two columns.
    std::vector<Rectangle> cover(std::size_t first_row, std::size_t end_row, TileRows::Extent columns) const {
        std::vector<Rectangle> found;
        for (const Part& part : join(strips(first_row, end_row, columns))) {
            std::vector<Rectangle> beside = split(part);
            if (beside.empty()) beside.push_back(part.pixels);
            found.insert(found.end(), beside.begin(), beside.end());
        }
        return found;
    }

    /// What is needed of a part without the widest gap in it, if that costs less than the whole; else nothing.
    std::vector<Rectangle> split(const Part& part) const {
        constexpr std::size_t least = 4;  // tiles: rectangles beside it begin and end with lines of the cache
        constexpr std::size_t least_pixels = 4 * copy_cost;  // that are worth a look
        const TileRows::Extent gap = widest_gap(part);
        const std::size_t width = gap.end - gap.begin;
        if (width < least || width * TILE * part.pixels.lines() < least_pixels) return {};
        std::vector<Rectangle> found = cover(part.first_row, part.end_row, {part.columns.begin, gap.begin});
        const std::vector<Rectangle> right = cover(part.first_row, part.end_row, {gap.end, part.columns.end});
        found.insert(found.end(), right.begin(), right.end());
        std::size_t cost = 0;
        for (const Rectangle& r : found) cost += r.size() + copy_cost;
        return cost < part.pixels.size() + copy_cost ? found : std::vector<Rectangle>();
    }

    /// Columns that no row of the part needs.
    TileRows::Extent widest_gap(const Part& part) const {
        std::vector<std::uint8_t> needed(part.columns.end - part.columns.begin);
        for (std::size_t row = part.first_row; row < part.end_row; ++row)
            for (std::size_t i = 0; i < needed.size(); ++i) needed[i] |= tiles_[row * across_ + part.columns.begin + i];
        TileRows::Extent widest;
        for (std::size_t begin = 0, i = 0; i < needed.size(); ++i) {
            if (needed[i]) begin = i + 1;
            if (i + 1 - begin > widest.end - widest.begin) widest = {begin, i + 1};
        }
        return {part.columns.begin + widest.begin, part.columns.begin + widest.end};
    }

    /// Of each row that needs any.
    std::vector<Part> strips(std::size_t first_row, std::size_t end_row, TileRows::Extent columns) const {
        std::vector<Part> found;
        for (std::size_t row = first_row; row < end_row; ++row) {
            const auto of_row = std::span(tiles_).subspan(row * across_ + columns.begin, columns.end - columns.begin);
            const TileRows::Extent extent = extent_of(of_row, columns.begin);
            if (!extent.is_empty()) found.push_back({row, row + 1, extent, pixels_of(rows_, row, extent, aligned_)});
        }
        return found;
    }

    /// The parts around strips that follow each other for which pixels and copies take least time in all.
    std::vector<Part> join(std::span<const Part> strips) const {
        constexpr std::size_t most = 64;  // strips of a part: as many are looked at from each
        struct Best {
            std::size_t cost = 0, begin = 0;  ///< of all strips before, and where the last part of them begins
            Part last;
        };
        std::vector<Best> best(strips.size() + 1);
        for (std::size_t end = 1; end <= strips.size(); ++end) {
            best[end].cost = SIZE_MAX;
            Part joined = strips[end - 1];
            for (std::size_t begin = end; begin-- > 0 && end - begin <= most;) {
                joined = around(joined, strips[begin]);
                if (!hold(rows_, joined.pixels)) break;
                const std::size_t cost = best[begin].cost + joined.pixels.size() + copy_cost;
                if (cost < best[end].cost) best[end] = {cost, begin, joined};
            }
        }
        std::vector<Part> found;
        for (std::size_t end = strips.size(); end > 0; end = best[end].begin) found.push_back(best[end].last);
        std::ranges::reverse(found);
        return found;
    }

    TileRows rows_;
    std::size_t across_, aligned_ = 0;
    std::vector<std::uint8_t> tiles_;  ///< row by row: not 0 where it is needed
};

}  // namespace

std::vector<Rectangle> find_rectangles(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end,
                                       std::span<const std::uint8_t> shown, const RenderTarget& target) {
    return Needed(frame, first, end, shown, target).rectangles();
}

void mark_covered(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end,
                  std::span<const std::uint8_t> shown, const RenderTarget& target) {
    const TileRows rows(frame, first, end);
    for (std::size_t row = 0; row < rows.count(); ++row) {
        const auto covered = rows.covered(row, target);
        std::ranges::copy(shown.subspan(rows.place(row, rows.whole(row).begin), covered.size()), covered.begin());
    }
}

Rectangle rows_of(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end) {
    const TileRows rows(frame, first, end);
    return {frame.screen.left, frame.screen.right, rows.top(0), rows.top(rows.count())};
}

}  // namespace csgrt
