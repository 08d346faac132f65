#include "device/compiling_device.hpp"
#include "device/copy_feed.hpp"

#include <chrono>
#include <cstddef>
#include <future>
#include <stdexcept>
#include <vector>

#include "catch.hpp"

using namespace csgrt;

TEST_CASE("a feed makes all copies, in pieces, beside other commands of the device", "[device]") {
    const bool is_registered = GENERATE(false, true);  // else by staging memory
    INFO("registered: " << is_registered);
    Device device(test::compiling_device());
    std::vector<float> values(10'000'007);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i % 16'777'213);
    const Buffer buffer(device, "lines", values);
    const Buffer other(device, "other", std::vector<float>{1, 2, 3});
    std::vector<std::vector<float>> made, expected;
    std::vector<std::shared_future<void>> done;
    {
        CopyFeed feed(device);
        const auto copies_of = [&](std::vector<CopyFeed::Copy> copies) {
            for (CopyFeed::Copy& copy : copies) {
                std::vector<float> to(copy.target_slice * copy.channels, -1);
                made.push_back(to);
                for (std::size_t c = 0; c < copy.channels; ++c)
                    for (std::size_t y = 0; y < copy.lines; ++y)
                        for (std::size_t x = 0; x < copy.columns; ++x)
                            to[c * copy.target_slice + y * copy.target_pitch + x] =
                                values[copy.begin + c * copy.slice + y * copy.pitch + x];
                expected.push_back(std::move(to));
                copy.target = made.back().data();  // which stays where it is when its vector is moved
            }
            return copies;
        };
        const auto add = [&](std::vector<CopyFeed::Copy> copies) {
            done.push_back(feed.add(buffer, copies_of(std::move(copies)), is_registered));
        };
        const auto copy = [](std::size_t columns, std::size_t lines, std::size_t channels, std::size_t begin,
                             std::size_t pitch, std::size_t slice) {
            return CopyFeed::Copy{.columns = columns,
                                  .lines = lines,
                                  .channels = channels,
                                  .begin = begin,
                                  .pitch = pitch,
                                  .slice = slice,
                                  .target = nullptr,
                                  .target_pitch = columns + 5,
                                  .target_slice = (columns + 5) * (lines + 1)};
        };
        add({copy(1000, 10'000, 1, 0, 1000, 10'000'000)});
        CHECK(other.read<float>(3) == std::vector<float>{1, 2, 3});
        add({copy(1024, 3000, 1, 7 * 1100, 1100, 0), copy(50, 1, 1, 10, 50, 0)});
        add({});
        add({copy(1300, 1000, 2, 17, 2000, 2'000'000), copy(3, 2, 3, 1, 10, 30),
             copy(32'768, 3, 64, 3, 32'768, 98'304)});
        for (const CopyFeed::Copy& wrong : {copy(5, 1, 1, 10'000'003, 5, 0), copy(2, 2, 2, 0, 2, 10'000'004),
                                            copy(CopyFeed::chunk / 2 + 1, 1, 2, 0, 2'000'000, 2'000'000)})
            CHECK_THROWS_AS(feed.add(buffer, {wrong}, is_registered), std::logic_error);
    }
    for (const std::shared_future<void>& all : done) {
        REQUIRE(all.wait_for(std::chrono::seconds(0)) == std::future_status::ready);  // its end comes after all copies
        CHECK_NOTHROW(all.get());
    }
    for (std::size_t i = 0; i < made.size(); ++i) {
        INFO("copy " << i);
        CHECK((made[i] == expected[i]));
    }
}

TEST_CASE("copies that a device refuses are told by their future, and those behind them are made", "[device]") {
    Device device(test::compiling_device());
    const std::vector<float> values(100, 3);
    const Buffer buffer(device, "lines", values);
    std::vector<float> host(100);
    CopyFeed feed(device);
    const CopyFeed::Copy copy{.columns = 100, .pitch = 100, .target_pitch = 100};
    CopyFeed::Copy somewhere = copy;
    somewhere.target = host.data();
    const auto refused = feed.add(buffer, {copy}, true);  // to nowhere
    const auto made = feed.add(buffer, {somewhere}, true);
    CHECK_THROWS_AS(refused.get(), Error);
    CHECK_NOTHROW(made.get());
    CHECK(host == values);
}
