// Before a tile whose pixels come by lines: its blocks in order, and the background of those that see nothing.
#include "pipeline/block_list.hpp"

#include <algorithm>
#include <random>

#include "catch.hpp"
#include "kernel_geometry.hpp"
#include "pipeline/rectangles.hpp"
#include "pipeline/same_answers.hpp"

using namespace csgrt;

TEST_CASE("a tile's blocks are listed once each, those that cost most first") {
    Device device(test::on_device().device);
    BlockList list(device);
    list.build();
    std::mt19937 random(3);
    TileBuffers buffers(device);
    for (const std::uint32_t blocks : {1u, 5u, 64u, 65u, 1000u, 5000u}) {
        INFO(blocks << " blocks");
        std::vector<unsigned char> costs(blocks);
        for (std::uint32_t i = 0; i < blocks; ++i) costs[i] = static_cast<unsigned char>(blocks == 1000 ? i % 256 : random() % 3 ? 0 : random() % 256);
        buffers.costs = Buffer(device, "costs", costs);
        const Tile tile{70 * block_rays, blocks * block_rays};
        buffers.tally.reserve(tile.tally_bytes());
        buffers.tally.queue_fill(0, tile.tally_bytes());
        for (const Event& event : list.list(tile, buffers)) wait_for(event);
        const auto tally = buffers.tally.read<kernel::TileTally>(1).front();
        const auto numbers = buffers.rays.read<std::uint32_t>(blocks);
        const auto bytes = buffers.tally.read<std::uint8_t>(sizeof tally + blocks);
        CHECK(tally.seen == blocks - static_cast<std::uint32_t>(std::count(costs.begin(), costs.end(), 0)));
        CHECK(tally.overflows == 0);
        CHECK(std::all_of(bytes.begin() + sizeof tally, bytes.end(), [](std::uint8_t shows) { return shows == 0; }));
        std::vector<std::uint32_t> sorted = numbers;
        std::sort(sorted.begin(), sorted.end());
        bool once = true, ordered = true;
        for (std::uint32_t i = 0; i < blocks; ++i) {
            once &= sorted[i] == 70 + i;
            const int cost = costs[numbers[i] - 70], next = i + 1 < blocks ? costs[numbers[i + 1] - 70] : 0;
            ordered &= (cost > 0) == (i < tally.seen) && (cost == 0 || next < 2 * cost);  // of one class, or of a lower one
        }
        CHECK(once);
        CHECK(ordered);
    }
}

TEST_CASE("blocks that see nothing are background, and the others are left alone") {
    Device device(test::on_device().device);
    BlockList list(device);
    list.build();
    kernel::Frame frame{};
    frame.width = 100;
    frame.height = 61;
    for (const kernel::Window window : {kernel::Window{0, 0, 100, 61}, kernel::Window{16, 8, 100, 56}, kernel::Window{24, 0, 64, 61}}) {
        INFO("window from " << window.left << ", " << window.top);
        frame.window = window;
        const std::uint32_t across = kernel::blocks_across(window), all = across * kernel::blocks_down(window);
        const std::uint32_t first = across + 2, end = all - 1;  // begins and ends within a row
        const Tile tile{first * block_rays, (end - first) * block_rays};
        const Rectangle lines = lines_of(frame, first, end);
        frame.lines = static_cast<std::uint32_t>(lines.lines());
        std::vector<unsigned char> costs(end - first);
        for (std::size_t i = 0; i < costs.size(); ++i) costs[i] = i % 3 == 0 ? 7 : 0;
        const Buffer on_device(device, "costs", costs);
        kernel::PlaneValues background{};
        for (int p = 0; p < 3; ++p) background.of[p] = 10.0f + static_cast<float>(p);
        const Buffer picture(device, "lines", std::vector<float>(3 * lines.size(), -1));
        wait_for(list.put_background(frame, tile, on_device, background, 3, picture));
        const auto pixels = picture.read<float>(3 * lines.size());
        std::vector<float> expected(pixels.size(), -1);
        for (std::uint32_t ray = tile.first; ray < tile.first + tile.rays; ++ray) {
            const kernel::pixel_position at = kernel::pixel_of(ray, window);
            if (!at.inside || costs[ray / block_rays - first]) continue;
            for (std::size_t p = 0; p < 3; ++p)
                expected[p * lines.size() + (at.y - lines.top) * lines.columns() + at.x - lines.left] = background.of[p];
        }
        CHECK(pixels == expected);
    }
}
