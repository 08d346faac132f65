// Depths in regions by their solids, beside where regions are.
#include <cmath>
#include <random>
#include <vector>

#include <csgrt/model.hpp>

#include "analysis/region_depth.hpp"
#include "catch.hpp"
#include "compile/random_parts.hpp"

using namespace csgrt;
using namespace csgrt::analysis;

namespace {

/// A region of some samples under random operators.
Scene random_region(test::RandomParts& random) {
    Scene scene;
    std::vector<TreeNode> nodes;
    for (int i = 0; i < 4; ++i) {
        Solid sample = random.some_solid();
        while (std::holds_alternative<Half>(sample.shape) || std::holds_alternative<Metaball>(sample.shape))
            sample = random.some_solid();
        sample.name += std::to_string(i);
        nodes.push_back(test::leg(sample.name, random.some_matrix()));
        scene.objects.push_back(std::move(sample));
        if (i == 0) continue;
        const TreeNode operators[] = {test::either, test::either, test::less, test::both, test::one_of};
        nodes.push_back(operators[random.below(std::size(operators))]);
    }
    scene.objects.push_back(test::region("r", std::move(nodes)));
    scene.top = {"r"};
    return scene;
}

}  // namespace

TEST_CASE("the ball of a known depth is all in the region or all outside, and supports have the region behind them") {
    test::RandomParts parts(3);
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> share(0, 1);
    const auto in_box = [&](const Box& box) {
        Vec3 p;
        for (double Vec3::*const axis : axes)
            p.*axis = box.low.*axis + share(random) * (box.high.*axis - box.low.*axis);
        return p;
    };
    std::size_t inside = 0, outside = 0, behind = 0;
    for (int n = 0; n < 60; ++n) {
        const Model model(random_region(parts), {}, {.device = "native"});
        if (model.regions().empty() || !has_inside(model.bounds())) continue;
        const Box all = model.bounds();
        const Vec3 more = 0.1 * (all.high - all.low);
        const Box box{all.low - more, all.high + more};
        const CompiledScene& scene = compiled_scene(model);
        const DistanceBounds bounds(scene);
        RegionDepth depth(scene, bounds, scene.flat_trees[0].nodes, box);
        std::vector<TangentPlane> planes;
        depth.append_supports(center_of(all), planes);
        const double size = length(all.high - all.low);
        std::vector<Vec3> points;
        std::vector<std::int32_t> expected;  // -2: any
        for (int i = 0; i < 200; ++i) {
            const Vec3 center = in_box(box);
            const Depth d = depth.at(center);
            points.push_back(center);
            expected.push_back(d.in > 1e-9 * size ? 0 : d.out > 1e-9 * size ? -1 : -2);
            inside += d.in > 0;
            outside += d.out > 0;
            for (int k = 0; k < 4; ++k) {
                const Vec3 way = in_box({{-1, -1, -1}, {1, 1, 1}});
                points.push_back(center + (0.999 * std::clamp(std::max(d.in, d.out), 0.0, size) / length(way)) * way);
                expected.push_back(expected[expected.size() - 1 - static_cast<std::size_t>(k)]);
            }
        }
        Array<std::int32_t> found;
        model.region_at(points, found);
        for (std::size_t i = 0; i < points.size(); ++i) {
            CAPTURE(n, i, points[i].x, points[i].y, points[i].z);
            if (expected[i] != -2) REQUIRE(found[i] == expected[i]);
            if (found[i] != 0) continue;
            for (const TangentPlane& plane : planes) REQUIRE(plane.distance(points[i]) > -1e-7 * size);
            behind += planes.size();
        }
    }
    CHECK(inside > 500);
    CHECK(outside > 2000);
    CHECK(behind > 500);
}
