// Bounds of distances.
#include <cmath>

#include "bench/methods/ray_forms.hpp"
#include "bench/methods/scene_rays.hpp"
#include "catch.hpp"
#include "compile/bounds/distance_bounds.hpp"
#include "compile/compiled_scene.hpp"
#include "method_solids.hpp"

using namespace csgrt;
using namespace csgrt::bench;

TEST_CASE("a bound changes by no more than the distance moved, and is negative in the solid and only there") {
    const CompiledScene scene = compile(test::closed_forms(false));
    REQUIRE(type_without_distance(scene).empty());
    const DistanceBounds bounds(scene);
    const SceneRays rays(scene);
    std::mt19937_64 random(5);
    std::vector<kernel::Boundary> boundaries;
    for (std::uint32_t solid = 0; solid < scene.solids.size(); ++solid) {
        CAPTURE(type_name(scene.solids[solid].type), solid);
        double steepest = 0;
        std::size_t within = 0;
        for (int i = 0; i < 4000; ++i) {
            const Vec3 a = test::point_near(scene.solid_boxes[solid], random);
            Vec3 b = test::point_near(scene.solid_boxes[solid], random);
            if (i % 2) b = {a.x + 1e-3 * (b.x - a.x), a.y + 1e-3 * (b.y - a.y), a.z + 1e-3 * (b.z - a.z)};
            const double moved = std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
            const double at_a = bounds.at(solid, a), change = std::abs(bounds.at(solid, b) - at_a);
            REQUIRE(change <= moved * (1 + 1e-9) + 1e-12);
            steepest = std::max(steepest, change / moved);

            boundaries.clear();
            rays.append_boundaries(solid, {a, {0.3, 0.4, 0.5}}, -HUGE_VAL, boundaries);
            bool inside = false, near = false;
            for (std::size_t e = 0; e < boundaries.size(); ++e) {
                if (boundaries[e].t < 0) inside = e % 2 == 0;
                near = near || std::abs(boundaries[e].t) < 1e-9;
            }
            if (near) continue;
            within += inside;
            REQUIRE((at_a < 0) == inside);
        }
        CHECK(within > 50);
        CHECK(steepest > 0.4);  // steps are not much too short
    }
}

TEST_CASE("solids without a bound are named") {
    CHECK(type_without_distance(compile(test::closed_forms(true))) == "hrt");
    Scene star;
    star.objects.emplace_back(test::solid("s", Superell{{}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 2.5, 1}));
    star.objects.emplace_back(test::region("r", {test::leg("s")}));
    CHECK(type_without_distance(compile(star)) == "superell with an exponent above 2");
}
