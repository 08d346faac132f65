// What a call says that it took.
#include <csgrt/renderer.hpp>

#include "stress/parts.hpp"
#include "catch.hpp"
#include "base/clock.hpp"
#include "integration/same_answers.hpp"

using namespace csgrt;

TEST_CASE("a call's time and the building of its kernels are told apart") {
    Renderer renderer(stress::scene_of_parts(20), {}, test::on_device());
    View view{.width = 8, .height = 8};
    for (const bool every_partition : {false, true}) {
        view.every_partition = every_partition;
        const double before = renderer.statistics().ms.build;
        const auto start = Clock::now();
        renderer.render(view);
        const double wall = milliseconds_since(start);
        const auto& ms = renderer.statistics().ms;
        CHECK(ms.build > before);
        CHECK(ms.frame > 0);
        CHECK(ms.frame + (ms.build - before) <= wall);
        const double built = ms.build;
        renderer.render(view);
        CHECK(renderer.statistics().ms.build == built);
    }
}

TEST_CASE(
    "segments and partitions are counted where every partition is computed, also on the rays of first hits that need "
    "it",
    "[promise:pictures]") {
    Renderer renderer(stress::scene_of_parts(20), {}, test::on_device());
    View view{.width = 32, .height = 32};
    const Image image = renderer.render(view);
    const Statistics every = renderer.statistics();
    std::uint64_t segments = 0, partitions = 0, overlaps = 0;
    for (const float depth : image.channel("depth")) segments += static_cast<std::uint64_t>(depth);
    for (const float count : image.channel("partitions")) partitions += static_cast<std::uint64_t>(count);
    for (const float count : image.channel("overlap")) overlaps += static_cast<std::uint64_t>(count);
    CHECK(every.segments == segments);
    CHECK(every.ends == 2 * every.segments);
    CHECK(every.partitions_used == partitions);
    CHECK(every.overlaps == overlaps);
    CHECK(every.partitions_allocated >= every.partitions_used);
    view.every_partition = false;
    renderer.render(view);
    CHECK(renderer.statistics().segments == 0);
    CHECK(renderer.statistics().partitions_used == 0);
}
