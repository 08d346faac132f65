// Before a batch whose picture is row-major: its tiles in order, and the background of those that see nothing.
#include "device/compiling_device.hpp"
#include "pipeline/passes/tile_list.hpp"

#include <algorithm>
#include <random>

#include "catch.hpp"
#include "kernel_host/geometry.hpp"
#include "pipeline/readback/picture.hpp"
#include "integration/same_answers.hpp"

using namespace csgrt;

TEST_CASE("a batch's tiles are listed once each, those that cost most first, the dearest in parts") {
    Device device(test::compiling_device());
    TileListPass list(device);
    list.build();
    std::mt19937 random(3);
    BatchBuffers buffers(device);
    struct Listed {
        std::uint32_t tiles, dearest, most_in_parts;  // dearest: one in so many; 0: none
        bool is_parted;
    };
    for (const auto& [tiles, dearest, most_in_parts, is_parted] : {Listed{1, 0, 0, false},
                                                                   {5, 0, 9, false},
                                                                   {64, 0, 9, false},
                                                                   {65, 1, 99, false},
                                                                   {1000, 20, 49, false},
                                                                   {1000, 20, 50, true},
                                                                   {5000, 50, 100, true},
                                                                   {5000, 50, 99, false},
                                                                   {5000, 50, 0, false},
                                                                   {5000, 2, 5000, false}}) {
        INFO(tiles << " tiles, one in " << dearest << " dear, at most " << most_in_parts << " in parts");
        std::vector<unsigned char> costs(tiles);
        for (std::uint32_t i = 0; i < tiles; ++i) {
            const bool is_dear = dearest > 0 && i % dearest == 0;
            costs[i] = static_cast<unsigned char>(is_dear ? 192 + random() % 64 : random() % 3 ? 0 : random() % 128);
        }
        buffers.costs = Buffer(device, "costs", costs);
        const RayBatch batch{70 * tile_rays, tiles * tile_rays};
        buffers.report.reserve(BatchBuffers::report_bytes(batch));
        buffers.report.queue_fill(0, BatchBuffers::report_bytes(batch));
        for (const Event& event : list.list(batch, buffers, most_in_parts)) wait_for(event);
        const auto tally = buffers.report.read<kernel::BatchReport>(1).front();
        const auto entries = buffers.tiles.read<std::uint32_t>(tiles);
        const auto bytes = buffers.report.read<std::uint8_t>(sizeof tally + tiles);
        CHECK(tally.overflows == 0);
        CHECK(std::all_of(bytes.begin() + sizeof tally, bytes.end(), [](std::uint8_t shows) { return shows == 0; }));
        REQUIRE(tally.entries <= tiles);
        std::vector<unsigned> listed(tiles);  // a bit a quarter
        bool ordered = true, any_parts = false;
        int before = 255;
        for (std::uint32_t i = 0; i < tally.entries; ++i) {
            const std::uint32_t tile = (entries[i] & ((1u << PART_SHIFT) - 1)) - 70, part = entries[i] >> PART_SHIFT;
            REQUIRE(tile < tiles);
            const int cost = costs[tile];
            const unsigned quarters = part == 0 ? 15 : 1u << (part - PARTS);
            CHECK((listed[tile] & quarters) == 0);
            listed[tile] |= quarters;
            any_parts |= part > 0;
            CHECK((part == 0 || (cost >= 192 && part >= PARTS && part < 2 * PARTS)));
            ordered &= cost > 0 && (cost <= before ||
                                    (before >= 16 && cost - before <= before / 8));  // of one class, or a lower one
            before = cost;
        }
        bool once = true;
        for (std::uint32_t i = 0; i < tiles; ++i) once &= listed[i] == (costs[i] > 0 ? 15u : 0u);
        CHECK(once);
        CHECK(ordered);
        CHECK(any_parts == is_parted);
    }
}

TEST_CASE("tiles that see nothing are background, and the others are left alone") {
    Device device(test::compiling_device());
    TileListPass list(device);
    list.build();
    kernel::Frame frame{};
    frame.width = 100;
    frame.height = 61;
    for (const kernel::ScreenBounds screen : {kernel::ScreenBounds{0, 0, 100, 61}, kernel::ScreenBounds{16, 8, 100, 56},
                                              kernel::ScreenBounds{24, 0, 64, 61}}) {
        INFO("screen from " << screen.left << ", " << screen.top);
        frame.screen = screen;
        const std::uint32_t across = kernel::tiles_across(screen), all = across * kernel::tiles_down(screen);
        for (const auto& [first, end] : {std::pair(across, all), {across + 2, 2 * across - 1}}) {  // rows; part of one
            const RayBatch batch{first * tile_rays, (end - first) * tile_rays};
            const Rectangle lines = rows_of(frame, first, end);
            frame.rows = static_cast<std::uint32_t>(lines.lines());
            std::vector<unsigned char> costs(end - first);
            for (std::size_t i = 0; i < costs.size(); ++i) costs[i] = i % 3 == 0 ? 7 : 0;
            const Buffer on_device(device, "costs", costs);
            kernel::ChannelValues background{};
            for (int p = 0; p < 3; ++p) background.of[p] = 10.0f + static_cast<float>(p);
            const Buffer picture(device, "lines", std::vector<float>(3 * lines.size(), -1));
            wait_for(list.write_background(frame, batch, on_device, background, 3, picture));
            const auto pixels = picture.read<float>(3 * lines.size());
            std::vector<float> expected(pixels.size(), -1);
            for (std::uint32_t ray = batch.first; ray < batch.first + batch.rays; ++ray) {
                const kernel::pixel_position at = kernel::pixel_of(ray, screen);
                if (!at.inside || costs[ray / tile_rays - first]) continue;
                for (std::size_t p = 0; p < 3; ++p)
                    expected[p * lines.size() + (at.y - lines.top) * lines.columns() + at.x - lines.left] =
                        background.of[p];
            }
            CHECK(pixels == expected);
        }
    }
}
