// Regions of FASTGEN: plain ones beat them, and plates beat volumes, wherever in the model they stand.
#include "catch.hpp"

#include <string>
#include <vector>

#include "integration/field/judge.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::stress;

namespace {

/// Regions of any shape that overlap, of every kind, in any order; in every other scene some are air.
StressScene mixed(std::uint64_t seed, std::size_t times) {
    Builder to("fastgen", seed, times);
    Random& random = to.random();
    for (int i = random.whole(3, 7); i > 0; --i) {
        std::vector<std::string> solids;
        for (int k = random.whole(1, 2); k > 0; --k) solids.push_back(some_solid(to));
        Tree tree = some_tree(solids, random);
        const int air = seed % 2 == 0 && random.below(4) == 0 ? 1 : 0;
        constexpr Fastgen kinds[] = {Fastgen::none, Fastgen::plate, Fastgen::volume};
        to.region(std::move(tree), air, kinds[random.below(3)]);
    }
    some_rays(to, 12, to.rays(20));
    return to.take();
}

}  // namespace

TEST_CASE("FASTGEN's regions yield to plain ones, volumes to plates", "[field][promise:overlap]") {
    test::judge_seeds(mixed, 1, 16, 1);
}
TEST_CASE("FASTGEN's regions yield on many rays", "[.long][promise:overlap]") {
    test::judge_seeds(mixed, 101, 500, 10);
}

TEST_CASE("a FASTGEN volume that the model lists first yields, and a note says what is not followed",
          "[field][promise:overlap]") {
    Builder to("volume", 1, 1);
    to.region(leaf(to.solid(box({0, 0, 0}, {6, 6, 6}))), 0, Fastgen::volume);
    to.region(leaf(to.solid(box({4, 0, 0}, {10, 6, 6}))));
    const StressScene made = to.take();
    Renderer renderer(made.scene, made.objects, test::on_reference());
    const auto answer = renderer.shoot({{{-9, 3, 3}, {1, 0, 0}}}).front();
    CHECK(answer.overlaps.empty());
    REQUIRE(answer.partitions.size() == 2);
    CHECK(renderer.model().regions()[answer.partitions[0].region].fastgen == Fastgen::volume);
    CHECK(answer.partitions[0].out == 13);
    CHECK(answer.partitions[1].out == 19);
    REQUIRE(renderer.model().warnings().size() == 1);
    CHECK(renderer.model().warnings()[0].reason.find("1 FASTGEN region, /r1 (volume): ") == 0);
    CHECK(renderer.model().warnings()[0].reason.find("thickness along the ray are not followed") != std::string::npos);
}
