// Air regions kept: solid beats air wherever in the model either stands, and only regions of one kind overlap.
#include "catch.hpp"

#include <string>
#include <utility>
#include <vector>

#include "integration/field/judge.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::stress;

namespace {

/// Regions in any order.
void add_shuffled(Builder& to, std::vector<std::pair<Tree, int>> regions) {
    while (!regions.empty()) {
        const std::uint32_t i = to.random().below(static_cast<std::uint32_t>(regions.size()));
        to.region(std::move(regions[i].first), regions[i].second);
        regions.erase(regions.begin() + i);
    }
}

/// Even seeds: a room of air behind its wall, as modellers make it, with things that stand in it, in each other and in
/// the wall. Odd ones: regions of any shape, half of them air.
StressScene airy(std::uint64_t seed, std::size_t times) {
    Builder to("air", seed, times);
    Random& random = to.random();
    std::vector<std::pair<Tree, int>> regions;
    if (seed % 2 == 0) {
        const double x = random.between(8, 14), y = random.between(8, 14), z = random.between(8, 14);
        const std::string outside = to.solid(box({-x, -y, -z}, {x, y, z}));
        const std::string inside = to.solid(box({1 - x, 1 - y, 1 - z}, {x - 1, y - 1, z - 1}));
        regions.push_back({operate(Operator::difference, {leaf(outside), leaf(inside)}), 0});
        regions.push_back({leaf(random.coin() ? inside : outside), 1});
        if (random.coin()) regions.push_back({leaf(inside), random.whole(1, 2)});
        for (int i = random.whole(1, 3); i > 0; --i) regions.push_back({leaf(some_solid(to)), 0});
    } else {
        for (int i = random.whole(3, 6); i > 0; --i) {
            std::vector<std::string> solids;
            for (int k = random.whole(1, 3); k > 0; --k) solids.push_back(some_solid(to));
            regions.push_back({some_tree(solids, random), random.coin() ? random.whole(1, 3) : 0});
        }
    }
    add_shuffled(to, std::move(regions));
    some_rays(to, 12, to.rays(20));
    return to.take();
}

}  // namespace

TEST_CASE("solid beats air, wherever it stands in the model", "[field][promise:overlap]") {
    test::judge_seeds(airy, 1, 16, 1);
}
TEST_CASE("solid beats air on many rays", "[.long][promise:overlap]") { test::judge_seeds(airy, 101, 500, 10); }

TEST_CASE("an air region that the model lists first yields to what stands in it", "[field][promise:overlap]") {
    Builder to("room", 1, 1);
    to.region(leaf(to.solid(box({0, 0, 0}, {10, 10, 10}))), 3);
    to.region(leaf(to.solid(box({4, 4, 4}, {6, 6, 6}))));
    const StressScene made = to.take();
    Settings settings = test::on_reference();
    settings.air = true;
    Renderer renderer(made.scene, made.objects, settings);
    const auto answer = renderer.shoot({{{5, -9, 5}, {0, 1, 0}}}).front();
    CHECK(answer.overlaps.empty());
    REQUIRE(answer.partitions.size() == 3);
    CHECK(renderer.model().regions()[answer.partitions[0].region].air == 3);
    CHECK(renderer.model().regions()[answer.partitions[1].region].air == 0);
    CHECK(answer.partitions[1].in == 13);
    CHECK(answer.partitions[1].out == 15);
    CHECK(renderer.model().regions()[answer.partitions[2].region].air == 3);

    // A picture counts no overlap, either, on the device or on the reference.
    Renderer device(made.scene, made.objects, [] {
        Settings on = test::on_device();
        on.air = true;
        return on;
    }());
    View view{.width = 32, .height = 32};
    const Image picture = renderer.render(view);
    test::require_same(picture, device.render(view));
    CHECK(renderer.statistics().overlaps == 0);
    CHECK(device.statistics().overlaps == 0);
}
