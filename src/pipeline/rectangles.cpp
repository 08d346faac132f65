#include "pipeline/rectangles.hpp"

#include <algorithm>
#include <cstring>

#include "kernel_geometry.hpp"

namespace csgrt {
namespace {

Rectangle around(const Rectangle& a, const Rectangle& b) {
    return {std::min(a.left, b.left), std::max(a.right, b.right), std::min(a.top, b.top), std::max(a.bottom, b.bottom)};
}

/// Blocks of a row, begin ... end - 1.
struct Extent {
    std::size_t begin = 0, end = 0;
    bool is_empty() const { return begin == end; }
};

/// Of bytes, the first of which is block `left`'s, from the first to the last that is not 0: eight at a time.
Extent extent_of(std::span<const std::uint8_t> bytes, std::size_t left) {
    const auto are_zero = [&](std::size_t at) {
        std::uint64_t eight = 0;
        std::memcpy(&eight, bytes.data() + at, sizeof eight);
        return eight == 0;
    };
    std::size_t begin = 0, end = bytes.size();
    while (begin + 8 <= end && are_zero(begin)) begin += 8;
    while (begin < end && bytes[begin] == 0) ++begin;
    while (end >= begin + 8 && are_zero(end - 8)) end -= 8;
    while (end > begin && bytes[end - 1] == 0) --end;
    return begin == end ? Extent{} : Extent{left + begin, left + end};
}

/// A tile's rows of blocks, the first and the last of which may be parts of rows.
class Rows {
public:
    Rows(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end)
        : across_((frame.width + BLOCK - 1) / BLOCK), first_(first), end_(end), first_row_(first / across_),
          count_((end + across_ - 1) / across_ - first_row_), width_(frame.width), height_(frame.height) {}

    std::size_t count() const { return count_; }

    /// The tile's blocks in a row.
    Extent whole(std::size_t row) const {
        const std::size_t start = (first_row_ + row) * across_;
        return {std::max(first_, start) - start, std::min(end_, start + across_) - start};
    }
    /// The target's account of a row.
    std::span<std::uint8_t> drawn(std::size_t row, const RenderTarget& target) const {
        const Extent all = whole(row);
        return target.drawn.subspan((first_row_ + row) * across_ + all.begin, all.end - all.begin);
    }
    /// What is shown of a row.
    Extent shown(std::size_t row, std::span<const std::uint8_t> shown) const {
        const Extent all = whole(row);
        const std::size_t start = (first_row_ + row) * across_;
        return extent_of(shown.subspan(start + all.begin - first_, all.end - all.begin), all.begin);
    }
    /// What the target holds of a row.
    Extent held(std::size_t row, const RenderTarget& target) const { return extent_of(drawn(row, target), whole(row).begin); }
    /// A row's pixels; where there is room beside them, whole lines of the processor's cache, the first of which begins with
    /// pixel `aligned`: a GPU writes those a quarter sooner (bench/NOTES.md).
    Rectangle pixels(std::size_t row, Extent extent, std::size_t aligned) const {
        constexpr std::size_t line = 64 / sizeof(float);
        const auto column = [&](std::size_t block) { return std::min(block * BLOCK, width_); };
        const Extent all = whole(row);
        std::size_t left = column(extent.begin), right = column(extent.end);
        const std::size_t before = (left + line - aligned) % line, behind = (aligned + line - right % line) % line;
        if (left >= column(all.begin) + before) left -= before;
        if (right + behind <= column(all.end)) right += behind;
        return {left, right, (first_row_ + row) * BLOCK, std::min((first_row_ + row + 1) * BLOCK, height_)};
    }
    /// Whether all of it is the tile's.
    bool holds(const Rectangle& r) const {
        const std::size_t top = r.top / BLOCK - first_row_, bottom = (r.bottom - 1) / BLOCK - first_row_;
        const auto fits = [&](std::size_t row) {
            const Extent all = whole(row);
            return r.left >= all.begin * BLOCK && r.right <= std::min(all.end * BLOCK, width_);
        };
        return fits(top) && fits(bottom);  // all rows between are whole
    }

private:
    std::size_t across_, first_, end_, first_row_, count_, width_, height_;
};

}  // namespace

std::vector<Rectangle> find_rectangles(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end,
                                       std::span<const std::uint8_t> shown_blocks, const RenderTarget& target) {
    constexpr std::size_t copy_cost = 1 << 14;  // pixels; of what is copied the bus, not the begin of copies, is what takes time
    const Rows rows(frame, first, end);
    const std::size_t behind = reinterpret_cast<std::uintptr_t>(target.planes.front().pixels) % 64 / sizeof(float);
    std::vector<Rectangle> found;
    for (std::size_t row = 0; row < rows.count(); ++row) {
        const Extent shown = rows.shown(row, shown_blocks), held = rows.held(row, target);
        if (shown.is_empty() && held.is_empty()) continue;
        const Extent both = shown.is_empty()  ? held
                            : held.is_empty() ? shown
                                              : Extent{std::min(shown.begin, held.begin), std::max(shown.end, held.end)};
        const Rectangle next = rows.pixels(row, both, (16 - behind) % 16);
        if (!found.empty()) {
            const Rectangle joined = around(found.back(), next);
            if (rows.holds(joined) && joined.size() <= found.back().size() + next.size() + copy_cost) {
                found.back() = joined;
                continue;
            }
        }
        found.push_back(next);
    }
    return found;
}

Rectangle lines_of(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end) {
    const std::size_t across = (frame.width + BLOCK - 1) / BLOCK;
    return {0, frame.width, first / across * BLOCK, std::min<std::size_t>(frame.height, (end + across - 1) / across * BLOCK)};
}

}  // namespace csgrt
