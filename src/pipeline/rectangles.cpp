#include "pipeline/rectangles.hpp"

#include <algorithm>

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
    /// What find_shown says of a row.
    Extent shown(std::size_t row, std::span<const std::uint32_t> extents) const {
        return extents[2 * row] == 0 ? Extent{} : Extent{across_ - extents[2 * row + 1], extents[2 * row]};
    }
    /// What the target holds of a row.
    Extent held(std::size_t row, const RenderTarget& target) const {
        const auto bytes = drawn(row, target);
        const auto is_held = [](std::uint8_t byte) { return byte != 0; };
        const auto begin = std::find_if(bytes.begin(), bytes.end(), is_held);
        if (begin == bytes.end()) return {};
        const auto end = std::find_if(bytes.rbegin(), bytes.rend(), is_held).base();
        const std::size_t left = whole(row).begin;
        return {left + static_cast<std::size_t>(begin - bytes.begin()), left + static_cast<std::size_t>(end - bytes.begin())};
    }
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
                                       std::span<const std::uint32_t> extents, const RenderTarget& target) {
    constexpr std::size_t copy_cost = 1 << 14;  // pixels; of what is copied the bus, not the begin of copies, is what takes time
    const Rows rows(frame, first, end);
    const std::size_t behind = reinterpret_cast<std::uintptr_t>(target.planes.front().pixels) % 64 / sizeof(float);
    std::vector<Rectangle> found;
    for (std::size_t row = 0; row < rows.count(); ++row) {
        const Extent shown = rows.shown(row, extents), held = rows.held(row, target);
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

void mark_shown(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::span<const std::uint32_t> extents,
                const RenderTarget& target) {
    const Rows rows(frame, first, end);
    for (std::size_t row = 0; row < rows.count(); ++row) {
        const auto bytes = rows.drawn(row, target);
        const Extent shown = rows.shown(row, extents);
        std::fill(bytes.begin(), bytes.end(), std::uint8_t{0});
        if (shown.is_empty()) continue;
        const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(shown.begin - rows.whole(row).begin);
        std::fill_n(begin, shown.end - shown.begin, std::uint8_t{1});
    }
}

std::size_t rows_of(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end) { return Rows(frame, first, end).count(); }

}  // namespace csgrt
