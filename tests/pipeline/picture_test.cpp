// Blocks of pixels put into planes, in both ways in which memory is written.
#include "pipeline/picture.hpp"

#include <vector>

#include "catch.hpp"
#include "kernel_geometry.hpp"

using namespace csgrt;

namespace {

constexpr std::uint32_t block_pixels = BLOCK * BLOCK;

// Planes that all lie in one place count as so many bytes; the last one is what is seen there.
void require_put(std::uint32_t width, std::uint32_t height, std::size_t plane_count) {
    INFO(width << " x " << height << ", planes " << plane_count);
    kernel::Frame frame{};
    frame.width = width;
    frame.height = height;
    const std::uint32_t across = (width + BLOCK - 1) / BLOCK, blocks = across * ((height + BLOCK - 1) / BLOCK);
    const std::vector<std::uint32_t> drawn{0, 1, 3, across - 1, across, 2 * across + 5, blocks - across, blocks - 1};
    const auto count = static_cast<std::uint32_t>(drawn.size());
    std::vector<std::uint32_t> places(count);
    for (std::uint32_t i = 0; i < count; ++i) places[i] = count - 1 - i;
    std::vector<float> values(plane_count * count * block_pixels);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i % 1'000'003);

    std::vector<float> pixels(std::size_t{width} * height, -1);
    std::vector<ChannelPlane> planes;
    for (std::size_t p = 0; p < plane_count; ++p) planes.push_back({pixels.data(), -2 - static_cast<float>(p)});
    put_blocks(frame, 0, blocks, drawn, places, values.data(), planes);

    std::vector<float> expected(pixels.size(), planes.back().background);
    const float* last = values.data() + (plane_count - 1) * count * block_pixels;
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t k = 0; k < block_pixels; ++k) {
            const kernel::pixel_position at = kernel::pixel_of(drawn[i] * block_pixels + k, width, height);
            if (at.inside) expected[std::size_t{at.y} * width + at.x] = last[places[i] * block_pixels + k];
        }
    CHECK((pixels == expected));  // not written out: a million numbers
}

}  // namespace

TEST_CASE("blocks come to their pixels, and the rest is background") {
    for (const std::uint32_t width : {128u, 124u, 121u}) require_put(width, 83, 3);
}

TEST_CASE("blocks come to their pixels past the caches, too, where lines can be written so") {
    for (const std::uint32_t width : {1024u, 1020u, 1021u}) require_put(width, 1027, 65);  // a little more than 2^28 bytes
}
