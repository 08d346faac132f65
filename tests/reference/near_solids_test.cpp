// What the reference does not try on a ray has no segment on it, also when boxes are too small.
#include "reference/near_solids.hpp"

#include <algorithm>

#include <csgrt/scene_io.hpp>

#include "catch.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"
#include "reference/intersect.hpp"
#include "sanitized.hpp"
#include "stress/parts.hpp"

using namespace csgrt;

namespace {

std::vector<std::uint32_t> near(const NearSolids& solids, const Ray& ray) {
    std::vector<std::uint32_t> found;
    solids.for_each(ray, [&](std::uint32_t solid) { found.push_back(solid); });
    return found;
}

/// A third smaller, about its centre, on every side.
Box shrunk(const Box& box) {
    const auto low = [](double a, double b) { return a + (b - a) / 6.5; };
    return {{low(box.low.x, box.high.x), low(box.low.y, box.high.y), low(box.low.z, box.high.z)},
            {low(box.high.x, box.low.x), low(box.high.y, box.low.y), low(box.high.z, box.low.z)}};
}

}  // namespace

TEST_CASE("a solid that a ray meets is near it, whatever the boxes say of it") {
    std::vector<Scene> scenes;
    for (const std::string& file : test::scene_files()) scenes.push_back(load_scene(file));
    REQUIRE(!scenes.empty());
    scenes.push_back(stress::scene_of_parts(300));
    std::size_t met = 0, tried = 0, all = 0;
    for (const Scene& scene : scenes) {
        INFO(scene.title);
        CompiledScene compiled = compile(scene);
        const NearSolids exact(compiled);
        for (Box& box : compiled.solid_boxes)
            if (box.high.x - box.low.x < 1e300) box = shrunk(box);
        const NearSolids small(compiled);
        const std::vector<Ray> rays = test::random_rays(compiled.bounds, test::sanitized ? 5 : 40);
        for (const Ray& ray : rays) {
            const std::vector<std::uint32_t> solids = near(exact, ray), fewer = near(small, ray);
            REQUIRE(std::is_sorted(solids.begin(), solids.end()));
            for (std::uint32_t solid = 0; solid < compiled.solids.size(); ++solid) {
                if (intersect_solid(compiled, solid, ray).empty()) continue;
                ++met;
                INFO("solid " << compiled.solid_info[solid].name);
                REQUIRE(std::binary_search(solids.begin(), solids.end(), solid));
                REQUIRE(std::binary_search(fewer.begin(), fewer.end(), solid));
            }
            tried += solids.size();
            all += compiled.solids.size();
        }
    }
    CHECK(met > 100);
    CHECK(tried < all / 3);
}

TEST_CASE("solids near a ray are the same whatever its length, and from wherever it starts") {
    const CompiledScene compiled = compile(stress::scene_of_parts(300));
    const NearSolids solids(compiled);
    for (const Ray& ray : test::random_rays(compiled.bounds, 50)) {
        const std::vector<std::uint32_t> expected = near(solids, ray);
        CHECK(expected.size() < compiled.solids.size());
        const Vec3 &o = ray.origin, &d = ray.direction;
        for (const double scale : {0x1p-1000, 0x1p-500, 0x1p500, 0x1p1000})
            CHECK((near(solids, {o, {d.x * scale, d.y * scale, d.z * scale}}) == expected));
        for (const double back : {1e3, 1e9, 1e20, 1e200, 1e300}) {  // there are more of them as rounding moves the line
            const std::vector<std::uint32_t> found =
                near(solids, {{o.x - back * d.x, o.y - back * d.y, o.z - back * d.z}, d});
            const bool are_all_there = std::includes(found.begin(), found.end(), expected.begin(), expected.end());
            if (back < 1e4) CHECK(are_all_there);
            if (back > 1e199) CHECK(found.size() == compiled.solids.size());
        }
    }
}
