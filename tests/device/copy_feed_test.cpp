#include "device/copy_feed.hpp"

#include <chrono>
#include <cstddef>
#include <future>
#include <stdexcept>
#include <vector>

#include "catch.hpp"

using namespace csgrt;

TEST_CASE("a feed makes all copies, in pieces, beside other commands of the device", "[device]") {
    Device device;
    std::vector<float> values(5'000'003);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i % 16'777'213);
    const Buffer buffer(device, "lines", values);
    const Buffer other(device, "other", std::vector<float>{1, 2, 3});

    constexpr std::size_t columns = 1024, lines = 3000, pitch = 1100;
    std::vector<float> whole(values.size()), apart(pitch * lines, -1), wide(values.size(), -1), few(50, -1);
    std::vector<std::shared_future<void>> done;
    {
        CopyFeed feed(device);
        done.push_back(feed.add(buffer, {{0, whole.data(), values.size(), values.size(), 1}}, Event()));
        CHECK(other.read<float>(3) == std::vector<float>{1, 2, 3});
        done.push_back(feed.add(buffer, {{7 * columns, apart.data(), pitch, columns, lines}, {10, few.data(), 50, 50, 1}}, Event()));
        done.push_back(feed.add(buffer, {}, Event()));
        done.push_back(feed.add(buffer, {{0, wide.data(), 2'500'000, 2'500'000, 2}, {0, nullptr, 9, 9, 0}, {0, nullptr, 0, 0, 5}}, Event()));
        CHECK_THROWS_AS(feed.add(buffer, {{4'999'999, whole.data(), 5, 5, 1}}, Event()), std::logic_error);
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
    CHECK(few == std::vector<float>(values.begin() + 10, values.begin() + 60));
    CHECK(std::vector<float>(wide.begin(), wide.begin() + 5'000'000) == std::vector<float>(values.begin(), values.begin() + 5'000'000));
}

TEST_CASE("copies that a device refuses are told by their future, and those behind them are made", "[device]") {
    Device device;
    const std::vector<float> values(100, 3);
    const Buffer buffer(device, "lines", values);
    std::vector<float> host(100);
    CopyFeed feed(device);
    const auto refused = feed.add(buffer, {{0, nullptr, 100, 100, 1}}, Event());  // to nowhere
    const auto made = feed.add(buffer, {{0, host.data(), 100, 100, 1}}, Event());
    CHECK_THROWS_AS(refused.get(), Error);
    CHECK_NOTHROW(made.get());
    CHECK(host == values);
}

TEST_CASE("a feed waits for what its copies come after", "[device]") {
    Device device;
    const Buffer buffer(device, "lines", std::vector<float>(100, 3));
    std::vector<float> host(100, -1);
    cl_int code = CL_SUCCESS;
    CopyFeed feed(device);
    const Event before(clCreateUserEvent(device.context(), &code));
    REQUIRE(code == CL_SUCCESS);
    REQUIRE(clRetainEvent(before.get()) == CL_SUCCESS);
    const auto made = feed.add(buffer, {{0, host.data(), 100, 100, 1}}, Event(before.get()));
    CHECK(made.wait_for(std::chrono::milliseconds(30)) == std::future_status::timeout);
    CHECK(host[0] == -1);
    REQUIRE(clSetUserEventStatus(before.get(), CL_COMPLETE) == CL_SUCCESS);
    CHECK_NOTHROW(made.get());
    CHECK(host == std::vector<float>(100, 3));
}
