// The generated scenes: as many solids as asked for, sound, the same everywhere, and pictures that compare.
#include <algorithm>
#include <vector>

#include <csgrt/renderer.hpp>

#include "catch.hpp"
#include "compile/compiled_scene.hpp"
#include "sanitized.hpp"
#include "stress/parts.hpp"

using namespace csgrt;

TEST_CASE("scenes of parts have the solids asked for and compile") {
    for (const std::uint32_t count : {3u, 4u, 7u, 100u, 101u, 102u, 103u, std::uint32_t{test::tries(2000)}}) {
        const Scene scene = stress::scene_of_parts(count);
        CHECK(validate(scene).empty());
        const CompiledScene compiled = compile(scene);
        CHECK(compiled.solids.size() == count);
        CHECK(compiled.regions.size() >= count / 5);
        CHECK(compiled.warnings.empty());
    }
}

TEST_CASE("a seed gives one scene, another seed another") {
    const std::uint64_t hash = compile(stress::scene_of_parts(500)).hash;
    CHECK(compile(stress::scene_of_parts(500)).hash == hash);
    CHECK(compile(stress::scene_of_parts(500, 2)).hash != hash);
}

TEST_CASE("whatever their number, parts cover the picture about alike, about as deep") {
    std::vector<double> covered, deep;
    for (const std::uint32_t count : {100u, 1000u, 10'000u}) {
        if (test::sanitized && count > 1000) break;
        Renderer renderer(stress::scene_of_parts(count));
        View view;
        view.width = view.height = 96;
        const Image image = renderer.render(view);
        const std::span<const std::uint32_t> region = image.ids("region");
        const auto hits = std::count_if(region.begin(), region.end(), [](std::uint32_t r) { return r > 0; });
        covered.push_back(static_cast<double>(hits) / (96 * 96));
        deep.push_back(static_cast<double>(renderer.statistics().segments) / static_cast<double>(hits));
    }
    for (std::size_t i = 0; i < covered.size(); ++i) {
        CAPTURE(i, covered[i], deep[i]);
        CHECK(covered[i] > 0.2);
        CHECK(covered[i] < 1.3 * covered[0]);
        CHECK(covered[0] < 1.3 * covered[i]);
        CHECK(deep[i] < 1.5 * deep[0]);
        CHECK(deep[0] < 1.5 * deep[i]);
    }
}
