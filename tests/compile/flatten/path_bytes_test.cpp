// Names that are long, in paths that are long, of regions that are many: their paths are bounded.
#include "catch.hpp"

#include "compile/compiled_scene.hpp"
#include "scene/make_scene.hpp"
#include "thrown.hpp"

using namespace csgrt;

namespace {

/// 2^`doublings` balls and as many regions below `chain` combinations whose names have 200 letters.
Scene long_paths(int doublings, int chain, int air) {
    std::vector<Object> objects = {ball("s")};
    Combination region = std::get<Combination>(combination("r", union_of({"s"})));
    region.region = true;
    region.air = air;
    objects.emplace_back(region);
    objects.emplace_back(combination("both", union_of({"s", "r"})));
    std::string below = "both";
    const auto add = [&](std::string name, const std::vector<std::string>& legs) {
        objects.push_back(combination(name, union_of(legs)));
        below = std::move(name);
    };
    for (int i = 0; i < doublings; ++i) add("d" + std::to_string(i), {below, below});
    for (int i = 0; i < chain; ++i) add(std::string(200, 'n') + std::to_string(i), {below});
    objects.emplace_back(combination("top", union_of({below})));
    return make_scene(std::move(objects));
}

}  // namespace

TEST_CASE("the paths of all regions are limited together, those of air as well") {
    for (const int air : {0, 1}) {
        CAPTURE(air);
        CHECK_NOTHROW(compile(long_paths(8, 500, air), {"top"}));                                            // 52 MB
        CHECK(test::says(test::failure(Status::scene, [&] { compile(long_paths(12, 500, air), {"top"}); }),  // 411 MB
                         "the paths of all regions have more than 256000000 bytes together"));
    }
}
