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

template <class Line>
void put_lines(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::span<const std::uint32_t> drawn,
               std::span<const std::uint32_t> places, const float* values, std::span<const ChannelPlane> planes) {
    const std::size_t width = frame.width, across = (width + BLOCK - 1) / BLOCK, size = drawn.size() * BLOCK * BLOCK;
    const std::size_t first_row = first / across, rows = (end + across - 1) / across - first_row;
    const std::size_t rows_a_chunk = std::max<std::size_t>(1, pixels_a_thread / (width * BLOCK));
    for_chunks(rows, rows_a_chunk, 0, [&](std::size_t row, std::size_t last, std::size_t) {
        for (; row < last; ++row) {
            const std::size_t start = (first_row + row) * across;  // the number of the row's first block
            const std::size_t from = std::max<std::size_t>(first, start),
                              to = std::min<std::size_t>(end, start + across);
            const auto begin = std::lower_bound(drawn.begin(), drawn.end(), from);
            const std::size_t height = std::min<std::size_t>(BLOCK, frame.height - (first_row + row) * BLOCK);
            for (std::size_t p = 0; p < planes.size(); ++p)
                for (std::size_t y = 0; y < height; ++y) {
                    float* line = planes[p].pixels + ((first_row + row) * BLOCK + y) * width;
                    std::size_t x = (from - start) * BLOCK;
                    auto block = begin;
                    for (; block != drawn.end() && *block < to; ++block) {
                        const std::size_t at = (*block - start) * BLOCK,
                                          next = std::min<std::size_t>(at + BLOCK, width);
                        const std::size_t place = places[static_cast<std::size_t>(block - drawn.begin())];
                        const float* source = values + p * size + place * BLOCK * BLOCK + y * BLOCK;
                        Line::fill(line + x, at - x, planes[p].background);
                        Line::copy(line + at, next - at, source);
                        x = next;
                    }
                    const std::size_t line_end = std::min<std::size_t>((to - start) * BLOCK, width);
                    if (x < line_end) Line::fill(line + x, line_end - x, planes[p].background);
                }
            Line::end();
        }
    });
}

}  // namespace

void put_blocks(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::span<const std::uint32_t> drawn,
                std::span<const std::uint32_t> places, const float* values, std::span<const ChannelPlane> planes) {
#ifdef __SSE2__
    if (Streamed::fits(frame, planes)) return put_lines<Streamed>(frame, first, end, drawn, places, values, planes);
#endif
    put_lines<Cached>(frame, first, end, drawn, places, values, planes);
}

void put_rays(const kernel::Frame& frame, std::span<const std::uint32_t> numbers, const float* values,
              std::span<const ChannelPlane> planes) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const kernel::pixel_position at = kernel::pixel_of(numbers[i], frame.width, frame.height);
        if (!at.inside) continue;
        for (std::size_t p = 0; p < planes.size(); ++p)
            planes[p].pixels[std::size_t{at.y} * frame.width + at.x] = values[p * numbers.size() + i];
    }
}

}  // namespace csgrt
