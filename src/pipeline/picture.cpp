#include "pipeline/picture.hpp"

#include <algorithm>
#include <array>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include "kernel_geometry.hpp"
#include "parallel.hpp"

namespace csgrt {
namespace {

constexpr std::size_t pixels_a_thread = 1 << 17;  // fewer are copied sooner than a thread starts

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
    static void end() { _mm_sfence(); }

    static bool fits(const kernel::Frame& frame, std::span<const ChannelPlane> planes) {
        constexpr std::size_t least_bytes = std::size_t{1} << 28;  // measured: bench/NOTES.md
        const std::size_t bytes = std::size_t{frame.width} * frame.height * planes.size() * sizeof(float);
        return bytes >= least_bytes && frame.width % lanes == 0 &&
               std::all_of(planes.begin(), planes.end(), [](const ChannelPlane& plane) {
                   return reinterpret_cast<std::uintptr_t>(plane.pixels) % sizeof(__m128) == 0;
               });
    }
};
#endif

/// Blocks of a row that stand side by side and are background, or a single one that was drawn.
struct Run {
    std::size_t begin, end;  ///< pixels of a line
    std::size_t place;       ///< of the drawn one, else `none`
    static constexpr std::size_t none = SIZE_MAX;
};

class Blocks {
public:
    Blocks(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::span<const std::uint32_t> drawn,
           std::span<const std::uint32_t> places, const float* values, const RenderTarget& target)
        : width_(frame.width), height_(frame.height), first_(first), end_(end), drawn_(drawn), places_(places), values_(values),
          target_(target) {
        const auto held = target.drawn.subspan(first_, end_ - first_);
        const auto clear = static_cast<std::size_t>(std::count(held.begin(), held.end(), 0));
        pixels_ = (drawn.size() + held.size() - clear) * BLOCK * BLOCK;
    }

    template <class Line>
    void put() const {
        const std::size_t first_row = first_ / across_, rows = (end_ + across_ - 1) / across_ - first_row;
        const std::size_t rows_a_chunk = std::max<std::size_t>(1, rows * pixels_a_thread / std::max<std::size_t>(pixels_, 1));
        for_chunks(rows, rows_a_chunk, target_.threads, [&](std::size_t row, std::size_t last, std::size_t) {
            std::vector<Run> runs;
            for (; row < last; ++row) {
                find_runs(first_row + row, runs);
                if (!runs.empty()) put_row<Line>(first_row + row, runs);
            }
            Line::end();
        });
    }

private:
    /// What is to be written of a row of blocks; and keeps what the row then holds.
    void find_runs(std::size_t row, std::vector<Run>& runs) const {
        runs.clear();
        const std::size_t start = row * across_;  // the number of the row's first block
        const std::size_t from = std::max(first_, start), to = std::min(end_, start + across_);
        auto next = static_cast<std::size_t>(std::lower_bound(drawn_.begin(), drawn_.end(), from) - drawn_.begin());
        for (std::size_t block = from; block < to; ++block) {
            const bool is_drawn = next < drawn_.size() && drawn_[next] == block;
            if (is_drawn || target_.drawn[block]) {
                const std::size_t begin = (block - start) * BLOCK, end = std::min<std::size_t>(begin + BLOCK, width_);
                if (is_drawn)
                    runs.push_back({begin, end, places_[next++]});
                else if (!runs.empty() && runs.back().place == Run::none && runs.back().end == begin)
                    runs.back().end = end;
                else
                    runs.push_back({begin, end, Run::none});
            }
            target_.drawn[block] = is_drawn;
        }
    }

    template <class Line>
    void put_row(std::size_t row, std::span<const Run> runs) const {
        const std::size_t lines = std::min<std::size_t>(BLOCK, height_ - row * BLOCK), size = drawn_.size() * BLOCK * BLOCK;
        for (std::size_t p = 0; p < target_.planes.size(); ++p) {
            const ChannelPlane& plane = target_.planes[p];
            for (std::size_t y = 0; y < lines; ++y) {
                float* line = plane.pixels + (row * BLOCK + y) * width_;
                for (const Run& run : runs) {
                    if (run.place != Run::none)
                        Line::copy(line + run.begin, run.end - run.begin, values_ + p * size + (run.place * BLOCK + y) * BLOCK);
                    else if (!plane.is_background)
                        Line::fill(line + run.begin, run.end - run.begin, plane.background);
                }
            }
        }
    }

    std::size_t width_, height_, first_, end_;
    std::size_t across_ = (width_ + BLOCK - 1) / BLOCK;  ///< blocks
    std::span<const std::uint32_t> drawn_, places_;
    const float* values_;
    const RenderTarget& target_;
    std::size_t pixels_;  ///< that are written, at most
};

}  // namespace

void put_blocks(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::span<const std::uint32_t> drawn,
                std::span<const std::uint32_t> places, const float* values, const RenderTarget& target) {
    const Blocks blocks(frame, first, end, drawn, places, values, target);
#ifdef __SSE2__
    if (Streamed::fits(frame, target.planes)) return blocks.put<Streamed>();
#endif
    blocks.put<Cached>();
}

void put_rays(const kernel::Frame& frame, std::span<const std::uint32_t> numbers, const float* values,
              const RenderTarget& target) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const kernel::pixel_position at = kernel::pixel_of(numbers[i], frame.width, frame.height);
        if (!at.inside) continue;
        target.drawn[numbers[i] / (BLOCK * BLOCK)] = 1;
        for (std::size_t p = 0; p < target.planes.size(); ++p)
            target.planes[p].pixels[std::size_t{at.y} * frame.width + at.x] = values[p * numbers.size() + i];
    }
}

}  // namespace csgrt
