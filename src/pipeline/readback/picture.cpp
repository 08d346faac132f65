#include "pipeline/readback/picture.hpp"

#include <algorithm>
#include <array>

#include "kernel_host/geometry.hpp"
#include "base/parallel.hpp"
#include "pipeline/readback/tile_rows.hpp"

namespace csgrt {
namespace {

// Fewer are copied sooner than a thread starts: pixels of tiles, and floats of long lines.
constexpr std::size_t pixels_a_thread = 1 << 17, floats_a_thread = 1 << 20;

/// A part of a channel's line.
void copy(float* to, std::size_t count, const float* values) {
    if (count == TILE) {
        std::array<float, TILE> eight;  // of a fixed size: no call
        std::copy_n(values, TILE, eight.begin());
        std::copy(eight.begin(), eight.end(), to);
    } else {
        std::copy_n(values, count, to);
    }
}

constexpr std::uint32_t not_drawn = UINT32_MAX;

/// Tiles of a row that stand side by side and are background, or a single one that was drawn.
struct Run {
    std::size_t begin, end;  ///< pixels of a line
    std::uint32_t place;     ///< of the drawn one, else not_drawn
};

class Tiles {
public:
    Tiles(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::span<const std::uint32_t> drawn,
          const float* values, const RenderTarget& target)
        : rows_(frame, first, end),
          width_(frame.width),
          drawn_(drawn.size()),
          values_(values),
          places_(end - first, not_drawn),
          target_(target) {
        for (std::size_t i = 0; i < drawn.size(); ++i) places_[drawn[i] - first] = static_cast<std::uint32_t>(i);
        std::size_t covered = 0;
        for (std::size_t row = 0; row < rows_.count(); ++row) covered += count_covered(rows_.covered(row, target));
        pixels_ = (drawn.size() + covered) * TILE * TILE;
    }

    void put() const {
        const std::size_t rows = rows_.count();
        const std::size_t rows_a_chunk =
            std::max<std::size_t>(1, rows * pixels_a_thread / std::max<std::size_t>(pixels_, 1));
        for_chunks(rows, rows_a_chunk, target_.threads, [&](std::size_t row, std::size_t last, std::size_t) {
            std::vector<Run> runs;
            for (; row < last; ++row) {
                find_runs(row, runs);
                if (!runs.empty()) put_row(row, runs);
            }
        });
    }

private:
    /// What is to be written of a row of tiles; and keeps what the row then holds.
    void find_runs(std::size_t row, std::vector<Run>& runs) const {
        runs.clear();
        const TileRows::Extent all = rows_.whole(row);
        const std::span<std::uint8_t> covered = rows_.covered(row, target_);
        for (std::size_t tile = all.begin; tile < all.end; ++tile) {
            const std::uint32_t place = places_[rows_.place(row, tile)];
            const bool is_drawn = place != not_drawn;
            std::uint8_t& holds = covered[tile - all.begin];
            if (is_drawn || holds) {
                const std::size_t begin = rows_.column(tile), end = rows_.column(tile + 1);
                if (!is_drawn && !runs.empty() && runs.back().place == not_drawn && runs.back().end == begin)
                    runs.back().end = end;
                else
                    runs.push_back({begin, end, place});
            }
            holds = is_drawn;
        }
    }

    void put_row(std::size_t row, std::span<const Run> runs) const {
        const std::size_t top = rows_.top(row), lines = rows_.top(row + 1) - top;
        for (std::size_t c = 0; c < target_.channels.size(); ++c) {
            const ChannelMemory& channel = target_.channels[c];
            for (std::size_t y = 0; y < lines; ++y) {
                float* line = channel.pixels + (top + y) * width_;
                for (const Run& run : runs) {
                    if (run.place != not_drawn)
                        copy(line + run.begin, run.end - run.begin,
                             values_ + ((c * drawn_ + run.place) * TILE + y) * TILE);
                    else
                        std::fill_n(line + run.begin, run.end - run.begin, channel.background);
                }
            }
        }
    }

    TileRows rows_;
    std::size_t width_;  ///< of the picture
    std::size_t drawn_;  ///< how many
    const float* values_;
    std::vector<std::uint32_t> places_;  ///< of the batch's tiles among the drawn ones
    const RenderTarget& target_;
    std::size_t pixels_;  ///< that are written, at most
};

}  // namespace

void put_tiles(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::span<const std::uint32_t> drawn,
               const float* values, const RenderTarget& target) {
    Tiles(frame, first, end, drawn, values, target).put();
}

void put_rectangles(const kernel::Frame& frame, std::span<const Rectangle> rectangles, const float* values,
                    const RenderTarget& target, const std::function<void(std::size_t)>& arrived) {
    struct ChannelLines {
        const Rectangle* rectangle;
        const float* values;
        float* pixels;
    };
    std::vector<ChannelLines> parts;
    std::size_t floats = 0;
    for (const Rectangle& r : rectangles)
        for (std::size_t p = 0; p < target.channels.size(); ++p) {
            parts.push_back(
                {&r, values + r.begin + p * r.size(), target.channels[p].pixels + r.top * frame.width + r.left});
            floats += r.size();
        }
    const std::size_t threads = 1 + floats / floats_a_thread;
    const unsigned most = thread_count(target.threads);
    for_chunks(parts.size(), 1, static_cast<unsigned>(std::min<std::size_t>(threads, most)),
               [&](std::size_t i, std::size_t, std::size_t) {
                   if (arrived) arrived(i);
                   const ChannelLines& part = parts[i];
                   const std::size_t columns = part.rectangle->columns();
                   for (std::size_t line = 0; line < part.rectangle->lines(); ++line)
                       std::copy_n(part.values + line * columns, columns, part.pixels + line * frame.width);
               });
}

void clear_around(const kernel::Frame& frame, const RenderTarget& target) {
    const kernel::ScreenBounds& screen = frame.screen;
    const kernel::ScreenBounds all{0, 0, frame.width, frame.height};
    const std::size_t across = kernel::tiles_across(all), down = kernel::tiles_down(all);
    const std::size_t left = screen.left / TILE, right = (screen.right + TILE - 1) / TILE;
    std::vector<std::size_t> covered;
    const auto find = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; (i = next_covered(target.covered, i, end)) < end; ++i) covered.push_back(i);
    };
    for (std::size_t row = 0; row < down; ++row) {
        const bool is_within = row * TILE >= screen.top && row * TILE < screen.bottom;
        find(row * across, row * across + (is_within ? left : across));
        if (is_within) find(row * across + right, (row + 1) * across);
    }
    for_chunks(covered.size(), pixels_a_thread / (TILE * TILE), target.threads,
               [&](std::size_t i, std::size_t last, std::size_t) {
                   for (; i < last; ++i) {
                       const std::size_t x = covered[i] % across * TILE, y = covered[i] / across * TILE;
                       const std::size_t columns = std::min<std::size_t>(TILE, frame.width - x);
                       for (const ChannelMemory& channel : target.channels)
                           for (std::size_t line = y; line < std::min<std::size_t>(y + TILE, frame.height); ++line)
                               std::fill_n(channel.pixels + line * frame.width + x, columns, channel.background);
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
            target.channels[p].pixels[std::size_t{at.y} * frame.width + at.x] = values[p * numbers.size() + i];
    }
}

}  // namespace csgrt
