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
    Device device(test::compiling_device());
    std::vector<float> values(5'000'003);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i % 16'777'213);
    const Buffer buffer(device, "lines", values);
    const Buffer other(device, "other", std::vector<float>{1, 2, 3});

    constexpr std::size_t columns = 1024, lines = 3000, pitch = 1100;
    std::vector<float> whole(values.size()), apart(pitch * lines, -1), wide(values.size(), -1), few(50, -1),
        channels(2 * 2600 * 1000, -1), small(18, -1);
    std::vector<std::shared_future<void>> done;
    {
        CopyFeed feed(device);
        done.push_back(feed.add(buffer, {{.columns = values.size(), .target = whole.data()}}));
        CHECK(other.read<float>(3) == std::vector<float>{1, 2, 3});
        done.push_back(feed.add(buffer, {{.columns = columns,
                                          .lines = lines,
                                          .begin = 7 * columns,
                                          .pitch = columns,
                                          .target = apart.data(),
                                          .target_pitch = pitch},
                                         {.columns = 50, .begin = 10, .target = few.data()}}));
        done.push_back(feed.add(buffer, {}));
        done.push_back(feed.add(
            buffer,
            {{.columns = 2'500'000, .lines = 2, .pitch = 2'500'000, .target = wide.data(), .target_pitch = 2'500'000},
             {.columns = 9, .lines = 0},
             {.columns = 0, .lines = 5}}));
        // Of two channels of 1,000 lines a part, line by line side by side; and of three small ones, one behind the
        // other.
        done.push_back(feed.add(buffer, {{.columns = 1300,
                                          .lines = 1000,
                                          .channels = 2,
                                          .begin = 17,
                                          .pitch = 2000,
                                          .slice = 2'000'000,
                                          .target = channels.data(),
                                          .target_pitch = 2600,
                                          .target_slice = 2'600'000}}));
        done.push_back(feed.add(buffer, {{.columns = 3,
                                          .lines = 2,
                                          .channels = 3,
                                          .begin = 1,
                                          .pitch = 10,
                                          .slice = 30,
                                          .target = small.data(),
                                          .target_pitch = 3,
                                          .target_slice = 6}}));
        CHECK_THROWS_AS(feed.add(buffer, {{.columns = 5, .begin = 4'999'999, .target = whole.data()}}),
                        std::logic_error);
        CHECK_THROWS_AS(feed.add(buffer, {{.columns = 2,
                                           .lines = 2,
                                           .channels = 2,
                                           .pitch = 2,
                                           .slice = 5'000'000,
                                           .target = whole.data(),
                                           .target_pitch = 2,
                                           .target_slice = 4}}),
                        std::logic_error);
        done[0].get();
        CHECK(whole == values);
    }
    for (const std::shared_future<void>& all : done) {
        REQUIRE(all.wait_for(std::chrono::seconds(0)) == std::future_status::ready);  // its end comes after all copies
        CHECK_NOTHROW(all.get());
    }
    std::vector<float> expected(apart.size(), -1);
    for (std::size_t y = 0; y < lines; ++y)
        for (std::size_t x = 0; x < columns; ++x) expected[y * pitch + x] = values[(7 + y) * columns + x];
    CHECK(apart == expected);
    std::vector<float> of_planes(channels.size(), -1), of_small;
    for (std::size_t p = 0; p < 2; ++p)
        for (std::size_t y = 0; y < 1000; ++y)
            for (std::size_t x = 0; x < 1300; ++x)
                of_planes[(p * 1000 + y) * 2600 + x] = values[17 + (p * 1000 + y) * 2000 + x];
    CHECK(channels == of_planes);
    for (std::size_t p = 0; p < 3; ++p)
        for (std::size_t y = 0; y < 2; ++y)
            for (std::size_t x = 0; x < 3; ++x) of_small.push_back(values[1 + 30 * p + 10 * y + x]);
    CHECK(small == of_small);
    CHECK(few == std::vector<float>(values.begin() + 10, values.begin() + 60));
    CHECK(std::vector<float>(wide.begin(), wide.begin() + 5'000'000) ==
          std::vector<float>(values.begin(), values.begin() + 5'000'000));
}

TEST_CASE("copies that a device refuses are told by their future, and those behind them are made", "[device]") {
    Device device(test::compiling_device());
    const std::vector<float> values(100, 3);
    const Buffer buffer(device, "lines", values);
    std::vector<float> host(100);
    CopyFeed feed(device);
    const auto refused = feed.add(buffer, {{.columns = 100}});  // to nowhere
    const auto made = feed.add(buffer, {{.columns = 100, .target = host.data()}});
    CHECK_THROWS_AS(refused.get(), Error);
    CHECK_NOTHROW(made.get());
    CHECK(host == values);
}
