// What devices take of a frame, or of a list: all rays, each once, in parts that cost about as much.
#include "pipeline/scheduling/frame_parts.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include "catch.hpp"
#include "pipeline/batch.hpp"

using namespace csgrt;

namespace {

/// A frame whose screen is so many tiles of a picture with a border, and what of the picture shows something.
struct Shown {
    Shown(std::uint32_t across, std::uint32_t down) : picture_across(across + 2), drawn((across + 2) * (down + 3)) {
        frame.width = (across + 2) * TILE - 3;
        frame.height = (down + 3) * TILE - 5;
        frame.screen = {TILE, 2 * TILE, (across + 1) * TILE, (down + 2) * TILE};
    }
    /// Of the screen's.
    std::uint8_t& at(std::uint32_t column, std::uint32_t row) { return drawn[(row + 2) * picture_across + column + 1]; }

    std::uint32_t picture_across;
    kernel::Frame frame{};
    std::vector<std::uint8_t> drawn;
};

std::vector<RayRange> all_of(Parts& parts) {
    std::vector<RayRange> taken;
    for (RayRange part = parts.take(); part.first < part.end; part = parts.take()) {
        REQUIRE(taken.size() < 10'000);
        taken.push_back(part);
    }
    return taken;
}

/// Each ray in one of them, and only tiles at their ends.
void check_whole(std::vector<RayRange> parts, std::uint64_t rays) {
    std::ranges::sort(parts, {}, &RayRange::first);
    std::uint64_t end = 0;
    for (const RayRange& part : parts) {
        CHECK(part.first == end);
        CHECK(part.first % tile_rays == 0);
        end = part.end;
    }
    CHECK(end == rays);
}

}  // namespace

TEST_CASE("what rays cost: as counted one by one, and found again from the cost") {
    std::mt19937 random(7);
    const auto below = [&](std::uint32_t count) { return static_cast<std::uint32_t>(random() % count); };
    for (int round = 0; round < 40; ++round) {
        const std::uint32_t across = 1 + below(40), down = round < 30 ? 1 + below(30) : 1 + below(1000);
        const std::uint32_t band = std::max(1u, down / RayCosts::most_bands);  // rows, for which one stands
        Shown shown(across, down);
        for (auto& tile : shown.drawn) tile = random() % 3 == 0;
        const auto middle = [&](std::uint32_t row) {
            return (row / band * band + std::min(down, (row / band + 1) * band)) / 2;
        };
        shown.at(0, middle(0)) = 1;
        const RayCosts costs(shown.frame, {.channels = {}, .covered = shown.drawn});
        REQUIRE(costs.rays() == across * down * tile_rays);
        std::uint64_t sum = 0;
        for (std::uint32_t row = 0; row < down; ++row) {
            CHECK(costs.before(row * across * tile_rays) == sum);
            for (std::uint32_t column = 0; column < across; ++column)
                sum += tile_rays * (shown.at(column, middle(row)) ? RayCosts::of_shown : 1);
        }
        CHECK(costs.total() == sum);
        for (int i = 0; i < 50; ++i) {
            const std::uint64_t first = random() % (across * down) * tile_rays, cost = random() % (sum + 10);
            const std::uint64_t end = costs.end(first, cost);
            REQUIRE(end > first);
            REQUIRE(end <= costs.rays());
            REQUIRE(end % tile_rays == 0);
            if (end < costs.rays())
                REQUIRE(costs.before(end) + RayCosts::of_shown >= std::min(costs.before(first) + cost, sum));
            const std::uint64_t more = across * tile_rays * RayCosts::of_shown;  // a row, at most
            REQUIRE(costs.before(end) <= costs.before(first) + cost + more);
            if (end >= first + 5 * across * tile_rays && end < costs.rays()) REQUIRE(end % (across * tile_rays) == 0);
        }
    }
}

TEST_CASE("rays of a picture that shows nothing yet cost the same, and those of a list") {
    Shown shown(10, 10);
    shown.drawn[0] = 1;  // outside of the screen
    const RayCosts costs(shown.frame, {.channels = {}, .covered = shown.drawn});
    CHECK(costs.total() == costs.rays() * RayCosts::of_shown);
    CHECK(costs.before(1234) == 1234 * RayCosts::of_shown);
    for (const std::uint64_t rays :
         {std::uint64_t{1}, std::uint64_t{63}, std::uint64_t{65'536}, std::uint64_t{100'000}, std::uint64_t{1} << 33}) {
        const RayCosts list(rays);
        CHECK(list.total() == rays * RayCosts::of_shown);
        CHECK(list.before(rays - 1) == (rays - 1) * RayCosts::of_shown);
        CHECK(list.end(0, list.total()) == rays);
        CHECK(list.end(0, 1) == std::min<std::uint64_t>(rays, tile_rays));
    }
}

TEST_CASE("parts are all rays, each once, whatever they show") {
    std::mt19937 random(11);
    const auto below = [&](std::uint32_t count) { return static_cast<std::uint32_t>(random() % count); };
    for (int round = 0; round < 200; ++round) {
        const std::uint32_t across = 1 + below(500), down = 1 + below(300), sparse = 1 + below(50);
        Shown shown(across, down);
        const std::uint32_t from = below(down);
        for (std::uint32_t row = from; row < down; ++row)
            for (std::uint32_t column = 0; column < across; ++column) shown.at(column, row) = random() % sparse == 0;
        const std::size_t devices = 1 + random() % 4;
        const RayCosts costs(shown.frame, {.channels = {}, .covered = shown.drawn});
        Parts parts(costs, devices, 1 + random() % 9, round % 2 == 0);
        check_whole(all_of(parts), costs.rays());
        const RayRange none = parts.take();
        CHECK(none.first == none.end);
    }
    for (const std::uint64_t rays : {std::uint64_t{0}, std::uint64_t{5}, std::uint64_t{1000}, std::uint64_t{1} << 26}) {
        Parts parts(RayCosts(rays), 2, 5, false);
        check_whole(all_of(parts), rays);
    }
}

TEST_CASE("devices' parts cost about as much, where most rays see nothing, too") {
    Shown shown(512, 512);
    for (std::uint32_t row = 300; row < 400; ++row)
        for (std::uint32_t column = 0; column < 512; ++column) shown.at(column, row) = 1;
    const RayCosts costs(shown.frame, {.channels = {}, .covered = shown.drawn});
    Parts parts(costs, 2, 5, false);
    const std::vector<RayRange> taken = all_of(parts);
    CHECK(taken.size() >= 10);
    CHECK(taken.size() <= 16);
    const std::uint64_t fair = costs.total() / 10, row = 512 * tile_rays * RayCosts::of_shown;
    for (const RayRange& part : taken)
        CHECK(costs.before(part.end) - costs.before(part.first) <= fair + fair / 4 + row);
    CHECK(taken[0].first == 0);
    CHECK(costs.before(taken[1].first) >= costs.total() / 2 - row);  // the other half's first
}

TEST_CASE("no part comes after a stop") {
    Parts parts(RayCosts(1 << 22), 2, 8, true);
    CHECK(parts.take().end > 0);
    parts.stop();
    const RayRange none = parts.take();
    CHECK(none.first == none.end);
}
