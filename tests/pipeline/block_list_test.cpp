// Before a tile whose pixels come by lines: its blocks in order, and the background of those that see nothing.
#include "device/compiling_device.hpp"
#include "pipeline/block_list.hpp"

#include <algorithm>
#include <random>

#include "catch.hpp"
#include "kernel_host/geometry.hpp"
#include "pipeline/rectangles.hpp"
#include "integration/same_answers.hpp"

using namespace csgrt;

TEST_CASE("a tile's blocks are listed once each, those that cost most first, the dearest in parts") {
    Device device(test::compiling_device());
    BlockList list(device);
    list.build();
    std::mt19937 random(3);
    TileBuffers buffers(device);
    struct Listed {
        std::uint32_t blocks, dearest, most_in_parts;  // dearest: one in so many; 0: none
        bool is_parted;
    };
    for (const auto& [blocks, dearest, most_in_parts, is_parted] :
         {Listed{1, 0, 0, false}, {5, 0, 9, false}, {64, 0, 9, false}, {65, 1, 99, false}, {1000, 20, 49, false}, {1000, 20, 50, true},
          {5000, 50, 100, true}, {5000, 50, 99, false}, {5000, 50, 0, false}, {5000, 2, 5000, false}}) {
        INFO(blocks << " blocks, one in " << dearest << " dear, at most " << most_in_parts << " in parts");
        std::vector<unsigned char> costs(blocks);
        for (std::uint32_t i = 0; i < blocks; ++i) {
            const bool is_dear = dearest > 0 && i % dearest == 0;
            costs[i] = static_cast<unsigned char>(is_dear ? 128 + random() % 128 : random() % 3 ? 0 : random() % 128);
        }
        buffers.costs = Buffer(device, "costs", costs);
        const Tile tile{70 * block_rays, blocks * block_rays};
        buffers.tally.reserve(tile.tally_bytes());
        buffers.tally.queue_fill(0, tile.tally_bytes());
        for (const Event& event : list.list(tile, buffers, most_in_parts)) wait_for(event);
        const auto tally = buffers.tally.read<kernel::TileTally>(1).front();
        const auto entries = buffers.rays.read<std::uint32_t>(blocks);
        const auto bytes = buffers.tally.read<std::uint8_t>(sizeof tally + blocks);
        CHECK(tally.overflows == 0);
        CHECK(std::all_of(bytes.begin() + sizeof tally, bytes.end(), [](std::uint8_t shows) { return shows == 0; }));
        REQUIRE(tally.entries <= blocks);
        std::vector<unsigned> listed(blocks);  // a bit a quarter
        bool ordered = true, any_parts = false;
        int before = 255;
        for (std::uint32_t i = 0; i < tally.entries; ++i) {
            const std::uint32_t block = (entries[i] & ((1u << PART_SHIFT) - 1)) - 70, part = entries[i] >> PART_SHIFT;
            REQUIRE(block < blocks);
            const int cost = costs[block];
            const unsigned quarters = part == 0 ? 15 : 1u << (part - PARTS);
            CHECK((listed[block] & quarters) == 0);
            listed[block] |= quarters;
            any_parts |= part > 0;
            CHECK((part == 0 || (cost >= 128 && part >= PARTS && part < 2 * PARTS)));
            ordered &= cost > 0 && (cost <= before || (before >= 16 && cost - before <= before / 8));  // of one class, or a lower one
            before = cost;
        }
        bool once = true;
        for (std::uint32_t i = 0; i < blocks; ++i) once &= listed[i] == (costs[i] > 0 ? 15u : 0u);
        CHECK(once);
        CHECK(ordered);
        CHECK(any_parts == is_parted);
    }
}

TEST_CASE("blocks that see nothing are background, and the others are left alone") {
    Device device(test::compiling_device());
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
