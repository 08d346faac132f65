// Tiles of pixels put into planes, in both ways in which memory is written.
#include "pipeline/readback/picture.hpp"

#include <vector>

#include "catch.hpp"
#include "kernel_host/geometry.hpp"

using namespace csgrt;

namespace {

constexpr std::uint32_t tile_pixels = TILE * TILE;

// Planes that all lie in one place count as so many bytes; the last one is what is seen there. `left`: some tiles of
// background are said to be it before. `screen`: what is not all of the picture is cleared around it.
void require_put(std::uint32_t width, std::uint32_t height, std::size_t plane_count, bool left,
                 kernel::ScreenBounds screen) {
    INFO(width << " x " << height << ", planes " << plane_count << ", some tiles left: " << left << ", screen "
               << screen.left << " to " << screen.right << ", " << screen.top << " to " << screen.bottom);
    kernel::Frame frame{};
    frame.width = width;
    frame.height = height;
    frame.screen = screen;
    const std::uint32_t across = kernel::tiles_across(screen),
                        tiles = across * ((screen.bottom - screen.top + TILE - 1) / TILE);
    const std::vector<std::uint32_t> drawn{0, 1, 3, across - 1, across, 2 * across + 5, tiles - across, tiles - 1};
    const auto count = static_cast<std::uint32_t>(drawn.size());
    const std::vector<std::uint32_t> in_any_order(drawn.rbegin(), drawn.rend());
    std::vector<float> values(plane_count * count * tile_pixels);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i % 1'000'003);

    std::vector<float> pixels(std::size_t{width} * height, -1);
    std::vector<ChannelMemory> planes;
    for (std::size_t p = 0; p < plane_count; ++p) planes.push_back({pixels.data(), -2 - static_cast<float>(p)});
    // Tiles that hold something else, some of them drawn anew; the others are left as they are.
    const std::uint32_t all_across = (width + TILE - 1) / TILE;
    std::vector<std::uint8_t> holds(all_across * ((height + TILE - 1) / TILE));
    for (std::uint32_t i = 0; i < holds.size(); ++i) holds[i] = !left || i % 5 < 3;
    const std::vector<std::uint8_t> before = holds;
    put_tiles(frame, 0, tiles, in_any_order, values.data(), {planes, holds});
    clear_around(frame, {planes, holds});

    std::vector<float> expected(pixels.size(), planes.back().background);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x)
            if (!before[y / TILE * all_across + x / TILE]) expected[std::size_t{y} * width + x] = -1;
    const float* last = values.data() + (plane_count - 1) * count * tile_pixels;
    std::vector<std::uint8_t> expected_holds(holds.size());
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t k = 0; k < tile_pixels; ++k) {
            const kernel::pixel_position at = kernel::pixel_of(drawn[i] * tile_pixels + k, screen);
            if (!at.inside) continue;
            expected[std::size_t{at.y} * width + at.x] = last[(count - 1 - i) * tile_pixels + k];
            expected_holds[at.y / TILE * all_across + at.x / TILE] = 1;
        }
    CHECK(holds == expected_holds);
    CHECK((pixels == expected));  // not written out: a million numbers
}

}  // namespace

TEST_CASE("tiles come to their pixels, and the rest is background") {
    for (const std::uint32_t width : {128u, 124u, 121u})
        for (const bool left : {false, true}) {
            require_put(width, 83, 3, left, {0, 0, width, 83});
            require_put(width, 83, 3, left, {16, 8, 96, 72});
            require_put(width, 83, 3, left, {40, 0, width, 83});
        }
}

TEST_CASE("tiles come to their pixels past the caches, too, where lines can be written so") {
    for (const std::uint32_t width : {1024u, 1020u, 1021u})
        require_put(width, 1027, 65, false, {0, 0, width, 1027});  // a little more than 2^28 bytes
    require_put(1024, 1027, 65, true, {0, 0, 1024, 1027});
    require_put(1024, 1027, 65, true, {8, 8, 1000, 1027});
}

TEST_CASE("a frame that sees nothing clears all of the picture") {
    kernel::Frame frame{};
    frame.width = 50;
    frame.height = 21;
    std::vector<float> pixels(50 * 21, 4);
    const std::vector<ChannelMemory> planes{{pixels.data(), 7}};
    std::vector<std::uint8_t> holds(7 * 3, 1);
    clear_around(frame, {planes, holds});
    CHECK(pixels == std::vector<float>(50 * 21, 7));
    CHECK(holds == std::vector<std::uint8_t>(7 * 3, 0));
}
