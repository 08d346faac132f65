#include "pipeline/picture.hpp"

#include <algorithm>
#include <array>

#include "kernel_geometry.hpp"
#include "parallel.hpp"

namespace csgrt {
namespace {

constexpr std::size_t pixels_a_thread = 1 << 17;  // fewer are copied sooner than a thread starts

}  // namespace

void put_blocks(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end,
                std::span<const std::uint32_t> drawn, std::span<const std::uint32_t> places, const float* values,
                std::span<const ChannelPlane> planes) {
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
                        std::fill(line + x, line + at, planes[p].background);
                        if (next - at == BLOCK) {
                            std::array<float, BLOCK> eight;  // of a fixed size: no call
                            std::copy_n(source, BLOCK, eight.begin());
                            std::copy(eight.begin(), eight.end(), line + at);
                        } else {
                            std::copy_n(source, next - at, line + at);
                        }
                        x = next;
                    }
                    const std::size_t line_end = std::min<std::size_t>((to - start) * BLOCK, width);
                    if (x < line_end) std::fill(line + x, line + line_end, planes[p].background);
                }
        }
    });
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
