#include "pipeline/picture.hpp"

#include <algorithm>
#include <array>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include "kernel_host/geometry.hpp"
#include "base/parallel.hpp"
#include "pipeline/block_rows.hpp"

namespace csgrt {
namespace {

// Fewer are copied sooner than a thread starts: pixels of blocks, and floats of long lines.
constexpr std::size_t pixels_a_thread = 1 << 17, floats_a_thread = 1 << 20;

/// How a part of a plane's line is written.
struct Cached {
    static void fill(float* to, std::size_t count, float value) { std::fill_n(to, count, value); }
    static void copy(float* to, std::size_t count, const float* values) {
        if (count == BLOCK) {
            std::array<float, BLOCK> eight;  // of a fixed size: no call
            std::copy_n(values, BLOCK, eight.begin());
            std::copy(eight.begin(), eight.end(), to);
        } else {
            std::copy_n(values, count, to);
        }
    }
    static void copy_line(float* to, std::size_t count, const float* values) { std::copy_n(values, count, to); }
    static void end() {}
};

#ifdef __SSE2__
/// Past the caches: memory that is overwritten need not be read first, which is half of what it does for a picture that the
/// caches do not hold. Every count is a multiple of `lanes`, every address one of their size.
struct Streamed {
    static constexpr std::size_t lanes = 4;
    static void fill(float* to, std::size_t count, float value) {
        const __m128 four = _mm_set1_ps(value);
        for (std::size_t i = 0; i < count; i += lanes) _mm_stream_ps(to + i, four);
    }
    static void copy(float* to, std::size_t count, const float* values) {
        for (std::size_t i = 0; i < count; i += lanes) _mm_stream_ps(to + i, _mm_loadu_ps(values + i));
    }
    static void copy_line(float* to, std::size_t count, const float* values) { copy(to, count, values); }
    static void end() { _mm_sfence(); }

    static bool fits(const kernel::Frame& frame, std::span<const ChannelPlane> planes) {
        constexpr std::size_t least_bytes = std::size_t{1} << 28;  // measured: docs/experiments/gpu-frames.md
        const std::size_t bytes = std::size_t{frame.width} * frame.height * planes.size() * sizeof(float);
        return bytes >= least_bytes && frame.width % lanes == 0 &&
               std::all_of(planes.begin(), planes.end(), [](const ChannelPlane& plane) {
                   return reinterpret_cast<std::uintptr_t>(plane.pixels) % sizeof(__m128) == 0;
               });
    }
};
#endif

constexpr std::uint32_t none = UINT32_MAX;

/// Blocks of a row that stand side by side and are background, or a single one that was drawn.
struct Run {
    std::size_t begin, end;  ///< pixels of a line
    std::uint32_t place;     ///< of the drawn one, else `none`
};

class Blocks {
public:
    Blocks(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::span<const std::uint32_t> drawn,
           const float* values, const RenderTarget& target)
        : rows_(frame, first, end), width_(frame.width), drawn_(drawn.size()), values_(values), places_(end - first, none),
          target_(target) {
        for (std::size_t i = 0; i < drawn.size(); ++i) places_[drawn[i] - first] = static_cast<std::uint32_t>(i);
        std::size_t held = 0;
        for (std::size_t row = 0; row < rows_.count(); ++row) held += count_held(rows_.held(row, target));
        pixels_ = (drawn.size() + held) * BLOCK * BLOCK;
    }

    template <class Line>
    void put() const {
        const std::size_t rows = rows_.count();
        const std::size_t rows_a_chunk = std::max<std::size_t>(1, rows * pixels_a_thread / std::max<std::size_t>(pixels_, 1));
        for_chunks(rows, rows_a_chunk, target_.threads, [&](std::size_t row, std::size_t last, std::size_t) {
            std::vector<Run> runs;
            for (; row < last; ++row) {
                find_runs(row, runs);
                if (!runs.empty()) put_row<Line>(row, runs);
            }
            Line::end();
        });
    }

private:
    /// What is to be written of a row of blocks; and keeps what the row then holds.
    void find_runs(std::size_t row, std::vector<Run>& runs) const {
        runs.clear();
        const BlockRows::Extent all = rows_.whole(row);
        const std::span<std::uint8_t> held = rows_.held(row, target_);
        for (std::size_t block = all.begin; block < all.end; ++block) {
            const std::uint32_t place = places_[rows_.place(row, block)];
            const bool is_drawn = place != none;
            std::uint8_t& holds = held[block - all.begin];
            if (is_drawn || holds) {
                const std::size_t begin = rows_.column(block), end = rows_.column(block + 1);
                if (!is_drawn && !runs.empty() && runs.back().place == none && runs.back().end == begin)
                    runs.back().end = end;
                else
                    runs.push_back({begin, end, place});
            }
            holds = is_drawn;
        }
    }

    template <class Line>
    void put_row(std::size_t row, std::span<const Run> runs) const {
        const std::size_t top = rows_.top(row), lines = rows_.top(row + 1) - top;
        for (std::size_t p = 0; p < target_.planes.size(); ++p) {
            const ChannelPlane& plane = target_.planes[p];
            for (std::size_t y = 0; y < lines; ++y) {
                float* line = plane.pixels + (top + y) * width_;
                for (const Run& run : runs) {
                    if (run.place != none)
                        Line::copy(line + run.begin, run.end - run.begin,
                                   values_ + ((p * drawn_ + run.place) * BLOCK + y) * BLOCK);
                    else
                        Line::fill(line + run.begin, run.end - run.begin, plane.background);
                }
            }
        }
    }

    BlockRows rows_;
    std::size_t width_;  ///< of the picture
    std::size_t drawn_;  ///< how many
    const float* values_;
    std::vector<std::uint32_t> places_;  ///< of the tile's blocks among the drawn ones
    const RenderTarget& target_;
    std::size_t pixels_;  ///< that are written, at most
};

}  // namespace

void put_blocks(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::span<const std::uint32_t> drawn,
                const float* values, const RenderTarget& target) {
    const Blocks blocks(frame, first, end, drawn, values, target);
#ifdef __SSE2__
    if (Streamed::fits(frame, target.planes)) return blocks.put<Streamed>();
#endif
    blocks.put<Cached>();
}

void put_rectangles(const kernel::Frame& frame, std::span<const Rectangle> rectangles, const float* values,
                    const RenderTarget& target, const std::function<void(std::size_t)>& arrived) {
    struct PlaneLines {
        const Rectangle* rectangle;
        const float* values;
        float* pixels;
    };
    std::vector<PlaneLines> parts;
    std::size_t floats = 0;
    for (const Rectangle& r : rectangles)
        for (std::size_t p = 0; p < target.planes.size(); ++p) {
            parts.push_back({&r, values + r.begin + p * r.size(), target.planes[p].pixels + r.top * frame.width + r.left});
            floats += r.size();
        }
    const auto put = [&]<class Line>(Line) {
        const std::size_t threads = 1 + floats / floats_a_thread;
        const unsigned most = thread_count(target.threads);
        for_chunks(parts.size(), 1, static_cast<unsigned>(std::min<std::size_t>(threads, most)),
                   [&](std::size_t i, std::size_t, std::size_t) {
                       if (arrived) arrived(i);
                       const PlaneLines& part = parts[i];
                       const std::size_t columns = part.rectangle->columns();
                       for (std::size_t line = 0; line < part.rectangle->lines(); ++line)
                           Line::copy_line(part.pixels + line * frame.width, columns, part.values + line * columns);
                       Line::end();
                   });
    };
#ifdef __SSE2__
    if (Streamed::fits(frame, target.planes)) return put(Streamed{});
#endif
    put(Cached{});
}

void clear_around(const kernel::Frame& frame, const RenderTarget& target) {
    const kernel::Window& window = frame.window;
    const kernel::Window all{0, 0, frame.width, frame.height};
    const std::size_t across = kernel::blocks_across(all), down = kernel::blocks_down(all);
    const std::size_t left = window.left / BLOCK, right = (window.right + BLOCK - 1) / BLOCK;
    std::vector<std::size_t> held;
    const auto find = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; (i = next_held(target.drawn, i, end)) < end; ++i) held.push_back(i);
    };
    for (std::size_t row = 0; row < down; ++row) {
        const bool is_within = row * BLOCK >= window.top && row * BLOCK < window.bottom;
        find(row * across, row * across + (is_within ? left : across));
        if (is_within) find(row * across + right, (row + 1) * across);
    }
    for_chunks(held.size(), pixels_a_thread / (BLOCK * BLOCK), target.threads, [&](std::size_t i, std::size_t last, std::size_t) {
        for (; i < last; ++i) {
            const std::size_t x = held[i] % across * BLOCK, y = held[i] / across * BLOCK;
            const std::size_t columns = std::min<std::size_t>(BLOCK, frame.width - x);
            for (const ChannelPlane& plane : target.planes)
                for (std::size_t line = y; line < std::min<std::size_t>(y + BLOCK, frame.height); ++line)
                    std::fill_n(plane.pixels + line * frame.width + x, columns, plane.background);
            target.drawn[held[i]] = 0;
        }
    });
}

void put_rays(const kernel::Frame& frame, std::span<const std::uint32_t> numbers, const float* values,
              const RenderTarget& target) {
    const std::size_t across = (frame.width + BLOCK - 1) / BLOCK;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const kernel::pixel_position at = kernel::pixel_of(numbers[i], frame.window);
        if (!at.inside) continue;
        target.drawn[at.y / BLOCK * across + at.x / BLOCK] = 1;
        for (std::size_t p = 0; p < target.planes.size(); ++p)
            target.planes[p].pixels[std::size_t{at.y} * frame.width + at.x] = values[p * numbers.size() + i];
    }
}

}  // namespace csgrt
