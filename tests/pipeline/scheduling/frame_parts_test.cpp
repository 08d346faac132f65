// What devices take of a frame, or of a list: all rays, each once, in parts that become smaller near the end.
#include "pipeline/scheduling/frame_parts.hpp"

#include <random>
#include <vector>

#include "catch.hpp"

using namespace csgrt;

namespace {

std::vector<RayNumbers> all_of(Parts& parts) {
    std::vector<RayNumbers> taken;
    for (RayNumbers part = parts.take(); part.first < part.end; part = parts.take()) {
        REQUIRE(taken.size() < 10'000);
        taken.push_back(part);
    }
    return taken;
}

}  // namespace

TEST_CASE("parts are all rays, each once, in whole units, no part larger than asked for") {
    std::mt19937_64 random(11);
    const auto below = [&](std::uint64_t count) { return random() % count; };
    for (int round = 0; round < 200; ++round) {
        const std::uint64_t unit = 1 + below(100'000), rays = below(300) * unit, devices = 1 + below(4);
        const std::uint64_t most = std::max(rays / devices / (1 + below(9)), unit), least = 1 + below(most);
        INFO("round " << round << ": " << rays << " rays, units of " << unit << ", " << least << " to " << most);
        Parts parts(rays, unit, devices, least, most);
        std::uint64_t end = 0;
        for (const RayNumbers& part : all_of(parts)) {
            CHECK(part.first == end);
            CHECK(part.first % unit == 0);
            CHECK(part.end - part.first < most + unit);
            end = part.end;
        }
        CHECK(end == rays);
    }
}

TEST_CASE("devices' parts are as large as asked for, then ever smaller, but no smaller than is worth a launch") {
    Parts parts(1 << 26, 1 << 13, 2, 1 << 16, 1 << 22);
    const std::vector<RayNumbers> taken = all_of(parts);
    CHECK(taken.front().end == 1 << 22);
    CHECK(taken.size() > 20);
    CHECK(taken.size() < 60);
    for (std::size_t i = 1; i < taken.size(); ++i)
        CHECK(taken[i].end - taken[i].first <= taken[i - 1].end - taken[i - 1].first);
    CHECK(taken.back().end - taken.back().first <= 1 << 16);
    CHECK(taken[taken.size() - 2].end - taken[taken.size() - 2].first == 1 << 16);
}

TEST_CASE("no part comes after a stop") {
    Parts parts(1 << 22, 1, 2, 1 << 10, 1 << 16);
    CHECK(parts.take().end > 0);
    parts.stop();
    const RayNumbers none = parts.take();
    CHECK(none.first == none.end);
}
