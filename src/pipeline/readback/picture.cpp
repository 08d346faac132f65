#include "pipeline/readback/picture.hpp"

#include <algorithm>
#include <cstring>

#include "kernel_host/geometry.hpp"
#include "base/parallel.hpp"

namespace csgrt {
namespace {

constexpr std::size_t pixels_a_thread = 1 << 17;  // fewer pixels are copied in less time than a thread takes to start

constexpr std::uint32_t not_drawn = UINT32_MAX;

/// The first tile from `begin` on whose byte is 1, or `end`.
std::size_t next_covered(std::span<const std::uint8_t> tiles, std::size_t begin, std::size_t end) {
    const void* const found = std::memchr(tiles.data() + begin, 1, end - begin);
    return found ? static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - tiles.data()) : end;
}

/// A batch's tiles, as numbers of tiles of the picture.
struct BatchTiles {
    BatchTiles(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end)
        : BatchTiles(frame.screen, frame.width, first, end) {}
    BatchTiles(const kernel::ScreenBounds& of, std::uint32_t width, std::uint32_t first, std::uint32_t end)
        : screen(of), across((width + TILE - 1) / TILE) {
        const std::size_t row = kernel::tiles_across(screen);
        left = screen.left / TILE + first % row;
        top = screen.top / TILE + first / row;
        columns = std::min<std::size_t>(end - first, row);
        rows = (end - first) / columns;
    }

    std::span<std::uint8_t> covered(std::size_t row, const RenderTarget& target) const {
        return target.covered.subspan((top + row) * across + left, columns);
    }
    /// Pixels of a row, from one column of the batch's tiles to another.
    Rectangle pixels(std::size_t row, std::size_t begin, std::size_t end) const {
        return {(left + begin) * TILE, std::min<std::size_t>((left + end) * TILE, screen.right), (top + row) * TILE,
                std::min<std::size_t>((top + row + 1) * TILE, screen.bottom)};
    }

    kernel::ScreenBounds screen;
    std::size_t across, left, top, columns, rows;
};

void fill(const ChannelMemory& channel, std::size_t width, const Rectangle& r) {
    if (!channel.has_memory()) return;
    for (std::size_t y = r.top; y < r.bottom; ++y)
        std::fill_n(channel.pixels + y * width + r.left, r.columns(), channel.background);
}

/// Writes a tile. `values`: the tile's pixels.
void put_tile(const ChannelMemory& channel, std::size_t width, const Rectangle& r, const float* values) {
    for (std::size_t y = r.top; y < r.bottom; ++y, values += TILE) {
        float* const line = channel.pixels + y * width + r.left;
        if (r.columns() == TILE)
            std::memcpy(line, values, TILE * sizeof(float));  // a fixed size needs no call
        else
            std::copy_n(values, r.columns(), line);
    }
}

/// Adds a rectangle that lies beneath the others. It is joined with the last rectangle if copying the pixels around the
/// two takes less time than another copy.
void add(std::vector<Rectangle>& all, const Rectangle& next) {
    constexpr std::size_t copy_cost = 1 << 12;  // pixels: docs/experiments.md
    if (!all.empty()) {
        Rectangle& last = all.back();
        const Rectangle both{std::min(last.left, next.left), std::max(last.right, next.right), last.top, next.bottom};
        if (both.size() <= last.size() + next.size() + copy_cost) {
            last = both;
            return;
        }
    }
    all.push_back(next);
}

}  // namespace

void put_tiles(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::span<const std::uint32_t> drawn,
               const float* values, const RenderTarget& target) {
    const BatchTiles tiles(frame, first, end);
    std::vector<std::uint32_t> places(end - first, not_drawn);
    for (std::size_t i = 0; i < drawn.size(); ++i) places[drawn[i] - first] = static_cast<std::uint32_t>(i);
    const std::size_t chunk = std::max<std::size_t>(1, pixels_a_thread / (tiles.columns * TILE * TILE));
    for_chunks(tiles.rows, chunk, 0, [&](std::size_t row, std::size_t last, std::size_t) {
        for (; row < last; ++row) {
            const std::span<std::uint8_t> covered = tiles.covered(row, target);
            const std::uint32_t* const of_row = places.data() + row * tiles.columns;
            for (std::size_t c = 0; c < target.channels.size(); ++c)
                for (std::size_t i = 0; i < tiles.columns; ++i) {
                    const Rectangle r = tiles.pixels(row, i, i + 1);
                    if (of_row[i] != not_drawn)
                        put_tile(target.channels[c], frame.width, r,
                                 values + (c * drawn.size() + of_row[i]) * TILE * TILE);
                    else if (covered[i])
                        fill(target.channels[c], frame.width, r);
                }
            for (std::size_t i = 0; i < tiles.columns; ++i) covered[i] = of_row[i] != not_drawn;
        }
    });
}

std::vector<Rectangle> take_rectangles(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end,
                                       std::span<const std::uint8_t> shown, const RenderTarget& target) {
    const BatchTiles tiles(frame, first, end);
    std::vector<Rectangle> found;
    std::vector<std::uint8_t> needed(tiles.columns);
    for (std::size_t row = 0; row < tiles.rows; ++row) {
        const auto own = shown.subspan(row * tiles.columns, tiles.columns);
        const auto covered = tiles.covered(row, target);
        for (std::size_t i = 0; i < tiles.columns; ++i) needed[i] = own[i] | covered[i];
        std::ranges::copy(own, covered.begin());
        std::size_t right = tiles.columns, left = next_covered(needed, 0, right);
        if (left == right) continue;
        while (!needed[right - 1]) --right;
        // Rectangles begin at whole lines of the processor's cache: so a GPU takes a quarter less time to write them
        // (docs/experiments.md).
        if (left > 0) left -= (tiles.left + left) % 2;
        if (right < tiles.columns) right += (tiles.left + right) % 2;
        add(found, tiles.pixels(row, left, right));
    }
    return found;
}

Rectangle rows_of(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end) {
    const BatchTiles tiles(frame, first, end);
    return {frame.screen.left, frame.screen.right, tiles.pixels(0, 0, 0).top,
            tiles.pixels(tiles.rows - 1, 0, 0).bottom};
}

void clear_around(const kernel::Frame& frame, const RenderTarget& target) {
    const kernel::ScreenBounds& screen = frame.screen;
    const BatchTiles all({0, 0, frame.width, frame.height}, frame.width, 0,
                         static_cast<std::uint32_t>(target.covered.size()));
    std::vector<std::size_t> covered;
    const auto find = [&](std::size_t row, std::size_t begin, std::size_t end) {
        for (end += row * all.columns, begin += row * all.columns;
             (begin = next_covered(target.covered, begin, end)) < end; ++begin)
            covered.push_back(begin);
    };
    for (std::size_t row = 0; row < all.rows; ++row) {
        const bool is_within = row * TILE >= screen.top && row * TILE < screen.bottom;
        find(row, 0, is_within ? screen.left / TILE : all.columns);
        if (is_within) find(row, (screen.right + TILE - 1) / TILE, all.columns);
    }
    for_chunks(covered.size(), pixels_a_thread / (TILE * TILE), 0, [&](std::size_t i, std::size_t last, std::size_t) {
        for (; i < last; ++i) {
            const std::size_t column = covered[i] % all.columns;
            for (const ChannelMemory& channel : target.channels)
                fill(channel, frame.width, all.pixels(covered[i] / all.columns, column, column + 1));
            target.covered[covered[i]] = 0;
        }
    });
}

void put_rays(const kernel::Frame& frame, std::span<const std::uint32_t> numbers, const float* values,
              const RenderTarget& target) {
    const std::size_t across = (frame.width + TILE - 1) / TILE;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const kernel::pixel_position at = kernel::pixel_of(numbers[i], frame.screen);
        if (!at.inside) continue;
        target.covered[at.y / TILE * across + at.x / TILE] = 1;
        for (std::size_t p = 0; p < target.channels.size(); ++p)
            if (target.channels[p].has_memory())
                target.channels[p].pixels[std::size_t{at.y} * frame.width + at.x] = values[p * numbers.size() + i];
    }
}

}  // namespace csgrt
