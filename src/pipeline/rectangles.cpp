#include "pipeline/rectangles.hpp"

#include <algorithm>
#include <cstring>

#include "pipeline/block_rows.hpp"

namespace csgrt {
namespace {

Rectangle around(const Rectangle& a, const Rectangle& b) {
    return {std::min(a.left, b.left), std::max(a.right, b.right), std::min(a.top, b.top), std::max(a.bottom, b.bottom)};
}

/// Of bytes, the first of which is block `left`'s, from the first to the last that is not 0: eight at a time.
BlockRows::Extent extent_of(std::span<const std::uint8_t> bytes, std::size_t left) {
    const auto are_zero = [&](std::size_t at) {
        std::uint64_t eight = 0;
        std::memcpy(&eight, bytes.data() + at, sizeof eight);
        return eight == 0;
    };
    std::size_t end = bytes.size();
    const std::size_t begin = next_held(bytes, 0, end);
    while (end >= begin + 8 && are_zero(end - 8)) end -= 8;
    while (end > begin && bytes[end - 1] == 0) --end;
    return begin == end ? BlockRows::Extent{} : BlockRows::Extent{left + begin, left + end};
}

/// A row's pixels; where there is room beside them, whole lines of the processor's cache, the first of which begins with
/// pixel `aligned`: a GPU writes those a quarter sooner (bench/NOTES.md).
Rectangle pixels_of(const BlockRows& rows, std::size_t row, BlockRows::Extent extent, std::size_t aligned) {
    constexpr std::size_t line = 64 / sizeof(float);
    const BlockRows::Extent all = rows.whole(row);
    std::size_t left = rows.column(extent.begin), right = rows.column(extent.end);
    const std::size_t before = (left + line - aligned) % line, behind = (aligned + line - right % line) % line;
    if (left >= rows.column(all.begin) + before) left -= before;
    if (right + behind <= rows.column(all.end)) right += behind;
    return {left, right, rows.top(row), rows.top(row + 1)};
}

/// Whether all of it is the tile's, whose rows but the first and the last are whole.
bool hold(const BlockRows& rows, const Rectangle& r) {
    const auto fits = [&](std::size_t line) {
        const BlockRows::Extent all = rows.whole(rows.row_of(line));
        return r.left >= rows.column(all.begin) && r.right <= rows.column(all.end);
    };
    return fits(r.top) && fits(r.bottom - 1);
}

/// The rectangles around strips that follow each other for which pixels and copies take least time in all.
std::vector<Rectangle> join(const BlockRows& rows, std::span<const Rectangle> strips) {
    constexpr std::size_t copy_cost = 1 << 12;  // pixels that a copy's begin takes as long as (bench/NOTES.md)
    constexpr std::size_t most = 256;           // strips of a rectangle: as many are looked at from each
    struct Best {
        std::size_t cost = 0, begin = 0;  ///< of all strips before, and where the last rectangle of them begins
        Rectangle last;
    };
    std::vector<Best> best(strips.size() + 1);
    for (std::size_t end = 1; end <= strips.size(); ++end) {
        best[end].cost = SIZE_MAX;
        Rectangle joined = strips[end - 1];
        for (std::size_t begin = end; begin-- > 0 && end - begin <= most;) {
            joined = around(joined, strips[begin]);
            if (!hold(rows, joined)) break;
            const std::size_t cost = best[begin].cost + joined.size() + copy_cost;
            if (cost < best[end].cost) best[end] = {cost, begin, joined};
        }
    }
    std::vector<Rectangle> found;
    for (std::size_t end = strips.size(); end > 0; end = best[end].begin) found.push_back(best[end].last);
    std::ranges::reverse(found);
    return found;
}

}  // namespace

std::vector<Rectangle> find_rectangles(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end,
                                       std::span<const std::uint8_t> shown_blocks, const RenderTarget& target) {
    const BlockRows rows(frame, first, end);
    const std::size_t behind = reinterpret_cast<std::uintptr_t>(target.planes.front().pixels) % 64 / sizeof(float);
    std::vector<Rectangle> strips;  // of each row that has any
    for (std::size_t row = 0; row < rows.count(); ++row) {
        const BlockRows::Extent all = rows.whole(row);
        const auto of_row = shown_blocks.subspan(rows.place(row, all.begin), all.end - all.begin);
        const BlockRows::Extent shown = extent_of(of_row, all.begin), held = extent_of(rows.held(row, target), all.begin);
        if (shown.is_empty() && held.is_empty()) continue;
        const BlockRows::Extent both = shown.is_empty()  ? held
                                       : held.is_empty() ? shown
                                                         : BlockRows::Extent{std::min(shown.begin, held.begin),
                                                                             std::max(shown.end, held.end)};
        strips.push_back(pixels_of(rows, row, both, (16 - behind) % 16));
    }
    return join(rows, strips);
}

void hold_shown(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::span<const std::uint8_t> shown,
                const RenderTarget& target) {
    const BlockRows rows(frame, first, end);
    for (std::size_t row = 0; row < rows.count(); ++row) {
        const auto held = rows.held(row, target);
        std::ranges::copy(shown.subspan(rows.place(row, rows.whole(row).begin), held.size()), held.begin());
    }
}

Rectangle lines_of(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end) {
    const BlockRows rows(frame, first, end);
    return {frame.window.left, frame.window.right, rows.top(0), rows.top(rows.count())};
}

}  // namespace csgrt
