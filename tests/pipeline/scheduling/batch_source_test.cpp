// Batches of a frame: all rays, each once, in whole rows of tiles or a part of one, whatever fits the memory.
#include "pipeline/scheduling/batch_source.hpp"

#include <algorithm>
#include <random>

#include "catch.hpp"

using namespace csgrt;

TEST_CASE("a batch is whole rows of tiles, or a part of one row, or of one tile; some come again in halves") {
    std::mt19937 random(3);
    const auto below = [&](std::uint64_t count) { return random() % count; };
    for (int round = 0; round < 300; ++round) {
        const std::uint64_t row = (1 + below(9)) * tile_rays, rays = (1 + below(12)) * row;
        const std::uint64_t most = 1 + below(round % 2 ? 3 * row : 100);
        INFO("round " << round << ": rows of " << row << " rays, " << rays << " in all, at most " << most);
        std::uint64_t taken = 0;
        const TakeRays take = [&] {  // parts of whole tiles
            const std::uint64_t first = taken;
            taken = std::min(rays, first + (1 + below(300)) * tile_rays);
            return RayNumbers{first, taken};
        };
        BatchSource source(
            take, [=] { return most; }, row);
        std::uint64_t done = 0;
        for (RayBatch batch = source.next(); batch.rays > 0; batch = source.next()) {
            REQUIRE(batch.first == done);
            REQUIRE(batch.rays <= most);
            const std::uint64_t end = std::uint64_t{batch.first} + batch.rays,
                                unit = batch.rays >= row ? row : tile_rays;
            if (batch.is_whole_tiles()) REQUIRE((batch.first % unit == 0 && end % unit == 0));
            if (batch.rays < row) REQUIRE(batch.first / row == (end - 1) / row);
            if (!batch.is_whole_tiles()) REQUIRE(batch.first / tile_rays == (end - 1) / tile_rays);
            if (batch.rays > 1 && below(4) == 0)
                source.halve(batch, 0);
            else
                done = end;
        }
        CHECK(done == rays);
    }
}

TEST_CASE("one ray that does not fit is refused, and a list's batches have any size") {
    BatchSource source([left = RayNumbers{0, 1000}]() mutable { return std::exchange(left, RayNumbers{}); },
                       [] { return 7; }, 0);
    CHECK(source.next() == RayBatch{0, 7});
    CHECK(source.next(1) == RayBatch{7, 1});
    CHECK_THROWS_AS(source.halve({7, 1}, 1 << 20), Error);
}
