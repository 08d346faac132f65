// What a GPU's batch brings of a picture: all that must be there, nothing of another batch's, in few copies.
#include "pipeline/readback/picture.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include "catch.hpp"

using namespace csgrt;

namespace {

struct Picture {
    Picture(std::uint32_t width, std::uint32_t height)
        : across((width + TILE - 1) / TILE), down((height + TILE - 1) / TILE) {
        frame.width = width;
        frame.height = height;
        pixels.resize(std::size_t{width} * height + 16);
        frame.screen = {0, 0, width, height};
        drawn.assign(std::size_t{across} * down, 0);
        auto* const begin = pixels.data();
        plane.pixels = begin + (64 - reinterpret_cast<std::uintptr_t>(begin) % 64) / sizeof(float) % 16;
    }
    RenderTarget target() { return {.channels = {&plane, 1}, .covered = drawn}; }

    std::uint32_t across, down;
    kernel::Frame frame{};
    std::vector<float> pixels;
    std::vector<std::uint8_t> drawn;
    ChannelMemory plane;
};

/// Of the batch's tiles, those that show something.
std::span<const std::uint8_t> of_batch(const std::vector<std::uint8_t>& shown, std::uint32_t first, std::uint32_t end) {
    return std::span(shown).subspan(first, end - first);
}

/// How often each pixel is in one of them.
std::vector<int> covered_by(const Picture& picture, const std::vector<Rectangle>& rectangles) {
    std::vector<int> times(std::size_t{picture.frame.width} * picture.frame.height, 0);
    for (const Rectangle& r : rectangles) {
        REQUIRE(r.right <= picture.frame.width);
        REQUIRE(r.bottom <= picture.frame.height);
        REQUIRE(r.size() > 0);
        for (std::size_t y = r.top; y < r.bottom; ++y)
            for (std::size_t x = r.left; x < r.right; ++x) ++times[y * picture.frame.width + x];
    }
    return times;
}

}  // namespace

TEST_CASE("rectangles hold what is shown and what was, each pixel once, and no other batch's") {
    std::mt19937 random(5);
    const auto below = [&](std::uint32_t count) { return static_cast<std::uint32_t>(random() % count); };
    for (int round = 0; round < 300; ++round) {
        const std::uint32_t width = 1 + below(400), height = 1 + below(300);
        Picture picture(width, height);
        kernel::ScreenBounds& screen = picture.frame.screen;
        if (round % 2) {  // whole tiles, cut off at the picture's edges
            const std::uint32_t left = below(picture.across), top = below(picture.down);
            screen = {left * TILE, top * TILE, std::min(width, (left + 1 + below(picture.across - left)) * TILE),
                      std::min(height, (top + 1 + below(picture.down - top)) * TILE)};
        }
        const std::uint32_t across = kernel::tiles_across(screen),
                            tiles = across * ((screen.bottom - screen.top + TILE - 1) / TILE);
        std::uint32_t first = below(tiles), end = first / across * across + across;  // a part of a row
        if (round % 3) {                                                             // whole rows
            first = first / across * across;
            end += below((tiles - first) / across) * across;
        } else {
            end -= below(end - first);
        }
        INFO("round " << round << ": " << width << " x " << height << ", of it " << screen.left << " to "
                      << screen.right << ", " << screen.top << " to " << screen.bottom << ", tiles " << first << " to "
                      << end);
        std::vector<std::uint8_t> shown(tiles);
        const std::uint32_t one_of = 1 + below(40);
        for (std::uint8_t& tile : shown) tile = below(one_of) == 0;
        for (std::uint8_t& tile : picture.drawn) tile = below(one_of) == 0;
        const std::vector<std::uint8_t> before = picture.drawn;
        const auto times = covered_by(
            picture, take_rectangles(picture.frame, first, end, of_batch(shown, first, end), picture.target()));
        const Rectangle lines = rows_of(picture.frame, first, end);
        CHECK(lines.left == screen.left);
        CHECK(lines.right == screen.right);
        CHECK(lines.top == screen.top + first / across * TILE);
        CHECK(lines.bottom == std::min(screen.bottom, screen.top + (end - 1) / across * TILE + TILE));
        bool all = true, once = true, own = true, told = true;
        for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < width; ++x) {
                const std::uint32_t held = y / TILE * picture.across + x / TILE;
                const bool is_within = x >= screen.left && x < screen.right && y >= screen.top && y < screen.bottom;
                const std::uint32_t tile =
                    is_within ? (y - screen.top) / TILE * across + (x - screen.left) / TILE : UINT32_MAX;
                const int covered = times[std::size_t{y} * width + x];
                const bool is_own = tile >= first && tile < end;
                all &= !is_own || !(shown[tile] || before[held]) || covered > 0;
                once &= covered <= 1;
                own &= is_own || covered == 0;
                told &= picture.drawn[held] == (is_own ? shown[tile] : before[held]);
            }
        CHECK(all);
        CHECK(once);
        CHECK(own);
        CHECK(told);
    }
}

TEST_CASE("rectangles join where that spares copies, and begin with lines of the cache") {
    Picture picture(4096, 4096);
    const std::uint32_t tiles = picture.across * picture.down;
    std::vector<std::uint8_t> shown(tiles, 0);
    const auto taken = [&] {
        std::ranges::fill(picture.drawn, std::uint8_t{0});
        return take_rectangles(picture.frame, 0, tiles, shown, picture.target());
    };
    CHECK(taken().empty());
    for (std::uint32_t row = 100; row < 105; ++row)  // a slanted bar
        for (std::uint32_t column = row + 1; column < row + 20; ++column) shown[row * picture.across + column] = 1;
    const auto bar = taken();
    REQUIRE(bar.size() == 1);
    CHECK(bar[0].top == 100 * TILE);
    CHECK(bar[0].bottom == 105 * TILE);
    CHECK(bar[0].left == 100 * TILE);  // one tile more than is shown
    CHECK(bar[0].right == 124 * TILE);
    CHECK(reinterpret_cast<std::uintptr_t>(picture.plane.pixels + bar[0].left) % 64 == 0);
    for (std::uint32_t column = 0; column < 512; ++column)
        shown[400 * picture.across + column] = 1;  // far below, all of a row
    const auto both = taken();
    REQUIRE(both.size() == 2);
    CHECK(both[1].columns() == 4096);
    CHECK(both[1].lines() == TILE);
    for (std::uint32_t row = 99; row > 0; row -= 3)  // few columns of many rows, with rows between them
        shown[row * picture.across + 100] = shown[row * picture.across + 101] = 1;
    const auto thin = taken();
    REQUIRE(thin.size() == 3);
    CHECK(thin[0].columns() == 2 * TILE);
    CHECK(thin[0].lines() == 97 * TILE);
}
