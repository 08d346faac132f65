// What a call says that it took.
#include <csgrt/renderer.hpp>

#include "bench/parts.hpp"
#include "catch.hpp"
#include "base/clock.hpp"
#include "integration/same_answers.hpp"

using namespace csgrt;

TEST_CASE("a call's time and the building of its kernels are told apart") {
    Renderer renderer(bench::scene_of_parts(20), {}, test::on_device());
    View view;
    view.width = view.height = 8;
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
