// Blocks of pixels put into planes, in both ways in which memory is written.
#include "pipeline/picture.hpp"

#include <algorithm>
#include <vector>

#include "catch.hpp"
#include "kernel_geometry.hpp"

using namespace csgrt;

namespace {

constexpr std::uint32_t block_pixels = BLOCK * BLOCK;

// Planes that all lie in one place count as so many bytes; the last one is what is seen there. `left`: some blocks of
// background are said to be it before.
void require_put(std::uint32_t width, std::uint32_t height, std::size_t plane_count, bool left) {
    INFO(width << " x " << height << ", planes " << plane_count << ", some blocks left: " << left);
    kernel::Frame frame{};
    frame.width = width;
    frame.height = height;
    const std::uint32_t across = (width + BLOCK - 1) / BLOCK, blocks = across * ((height + BLOCK - 1) / BLOCK);
    const std::vector<std::uint32_t> drawn{0, 1, 3, across - 1, across, 2 * across + 5, blocks - across, blocks - 1};
    const auto count = static_cast<std::uint32_t>(drawn.size());
    const std::vector<std::uint32_t> in_any_order(drawn.rbegin(), drawn.rend());
    std::vector<float> values(plane_count * count * block_pixels);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i % 1'000'003);

    std::vector<float> pixels(std::size_t{width} * height, -1);
    std::vector<ChannelPlane> planes;
    for (std::size_t p = 0; p < plane_count; ++p) planes.push_back({pixels.data(), -2 - static_cast<float>(p)});
    // Blocks that hold something else, some of them drawn anew; the others are left as they are.
    std::vector<std::uint8_t> holds(blocks);
    for (std::uint32_t i = 0; i < blocks; ++i) holds[i] = !left || i % 5 < 3;
    const std::vector<std::uint8_t> before = holds;
    put_blocks(frame, 0, blocks, in_any_order, values.data(), {planes, holds});

    std::vector<float> expected(pixels.size(), planes.back().background);
    const float* last = values.data() + (plane_count - 1) * count * block_pixels;
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t k = 0; k < block_pixels; ++k) {
            const kernel::pixel_position at = kernel::pixel_of(drawn[i] * block_pixels + k, width, height);
            if (at.inside) expected[std::size_t{at.y} * width + at.x] = last[(count - 1 - i) * block_pixels + k];
        }
    for (std::uint32_t block = 0; block < blocks; ++block) {
        const bool is_drawn = std::find(drawn.begin(), drawn.end(), block) != drawn.end();
        if (holds[block] != is_drawn) FAIL("block " << block << " is drawn or not: told wrongly");
        if (is_drawn || before[block]) continue;
        for (std::uint32_t k = 0; k < block_pixels; ++k) {
            const kernel::pixel_position at = kernel::pixel_of(block * block_pixels + k, width, height);
            if (at.inside) expected[std::size_t{at.y} * width + at.x] = -1;
        }
    }
    CHECK((pixels == expected));  // not written out: a million numbers
}

}  // namespace

TEST_CASE("blocks come to their pixels, and the rest is background") {
    for (const std::uint32_t width : {128u, 124u, 121u})
        for (const bool left : {false, true}) require_put(width, 83, 3, left);
}

TEST_CASE("blocks come to their pixels past the caches, too, where lines can be written so") {
    for (const std::uint32_t width : {1024u, 1020u, 1021u}) require_put(width, 1027, 65, false);  // a little more than 2^28 bytes
    require_put(1024, 1027, 65, true);
}
