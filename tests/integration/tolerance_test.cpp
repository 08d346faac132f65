// Which ends of segments along a ray are one, by each rule: surfaces that coincide, and ends that are close.
#include <string>
#include <vector>

#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "integration/same_answers.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::stress;

namespace {

Settings by(Tolerance rule, double tolerance = -1) {
    Settings settings = test::on_device();
    settings.tolerance_rule = rule;
    settings.tolerance = tolerance;
    return settings;
}

Scene scene_of(const std::vector<Shape>& shapes) {
    Scene scene;
    for (const Shape& shape : shapes)
        scene.objects.push_back(Solid{"s" + std::to_string(scene.objects.size()), shape, {}});
    return scene;
}

/// The second solid less the first; and both as one region.
Scene two_of(const Shape& a, const Shape& b) {
    Scene scene = scene_of({a, b});
    for (const bool joined : {false, true}) {
        Combination region{.name = joined ? "joined" : "rest", .region = true};
        region.tree = operate(joined ? Operator::union_ : Operator::difference, {leaf("s1"), leaf("s0")});
        scene.objects.push_back(region);
    }
    return scene;
}

/// Rays from 300 away through points within `size` of the origin.
std::vector<Ray> rays_near(double size, int count) {
    Random random(3);
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        const Vec3 d = random.direction();
        rays.push_back({size * random.in_cube() - 300 * d, d});
    }
    return rays;
}

/// The partitions of a region on the device, whose bits the reference has.
std::vector<RayPartitions> shot(const Scene& scene, const char* region, Settings settings,
                                const std::vector<Ray>& rays) {
    std::vector<RayPartitions> found = Renderer(scene, {region}, settings).shoot(rays);
    settings.reference = true;
    settings.device.clear();
    test::require_same(found, Renderer(scene, {region}, settings).shoot(rays));
    return found;
}

}  // namespace

TEST_CASE("the tolerance is the setting's, else the scene's, else what rounding separates", "[promise:coincidence]") {
    Scene scene = scene_of({box({-3, -2, -6}, {3, 2, 6})});  // its diagonal is 14
    const auto tolerance = [&](const Settings& settings) {
        return Renderer(scene, {}, settings).statistics().tolerance;
    };
    Settings single = by(Tolerance::length);
    single.reference = true;
    single.precision = Precision::single;
    for (const double of_scene : {0.0, 0.25}) {
        scene.tolerance = of_scene;
        CHECK(tolerance(by(Tolerance::length)) == Approx(of_scene > 0 ? of_scene : 14e-12));
        CHECK(tolerance(by(Tolerance::length, 0.5)) == 0.5);
        CHECK(tolerance(by(Tolerance::length, 0)) == 0);
        CHECK(tolerance(by(Tolerance::surfaces)) == Approx(14e-12));
        CHECK(tolerance(by(Tolerance::relative)) == Approx(14e-9));
        CHECK(tolerance(by(Tolerance::none)) == 0);
        single.tolerance_rule = Tolerance::relative;
        CHECK(tolerance(single) == Approx(14e-6));
        single.tolerance_rule = Tolerance::surfaces;
        CHECK(tolerance(single) == Approx(14e-6));
    }
    // Far away rounding separates more.
    scene = scene_of({box({7e9 - 4, -1, -1}, {7e9, 1, 1})});
    CHECK(tolerance(by(Tolerance::length)) == Approx(7e9 * 0x1p-49).epsilon(0.01));
}

TEST_CASE("a gap of 1e-9 of a solid's size is seen, and rounding is not, on every surface that solids share",
          "[promise:coincidence]") {
    struct {
        const char* name;
        Shape (*larger)(double by);
    } const shapes[] = {
        {"faces of boxes",
         [](double by) {
             return Shape(box({-20, -30, -40}, {20 + by, 30, 40}));
         }},
        {"balls",
         [](double by) {
             return Shape(ball({3, -1, 2}, 40 + by));
         }},
        {"tori",
         [](double by) {
             return Shape(Tor{{3, -1, 2}, {1, 2, 2}, 30, 10 + by});
         }},
        {"sides of cylinders",
         [](double by) {
             return Shape(cylinder({3, -1, 2}, {0, 30, 40}, 20 + by));
         }},
        {"sides of cones",
         [](double by) {
             return Shape(cone({3, -1, 2}, {0, 30, 40}, 30 + by, 10 + by));
         }},
    };
    for (const auto& each : shapes) {
        INFO(each.name);
        const double gap = 100 * 1e-9, rounding = 100 * 1e-14;
        std::size_t met = 0;
        for (const RayPartitions& answer :
             shot(two_of(each.larger(0), each.larger(gap)), "rest", by(Tolerance::surfaces), rays_near(40, 400)))
            for (const Partition& part : answer.partitions) {
                ++met;
                CHECK(part.out - part.in > 0.9 * gap);
            }
        CHECK(met > 50);
        for (const Tolerance rule : {Tolerance::surfaces, Tolerance::none})
            for (const RayPartitions& answer :
                 shot(two_of(each.larger(0), each.larger(rounding)), "rest", by(rule), rays_near(40, 400)))
                CHECK(answer.partitions.empty());
    }
}

TEST_CASE("a ball and the end of a particle are one, which are computed in two ways", "[promise:coincidence]") {
    const Part particle{{0, 0, -20}, {0, 0, 40}, 10, 10};
    std::size_t met = 0;
    for (const double z : {-20.0, 20.0}) {
        const Scene scene = two_of(particle, ball({0, 0, z}, 10));
        for (const RayPartitions& answer : shot(scene, "rest", by(Tolerance::length), rays_near(25, 500)))
            CHECK(answer.partitions.empty());
        for (const RayPartitions& answer : shot(scene, "joined", by(Tolerance::length), rays_near(25, 500))) {
            CHECK(answer.partitions.size() <= 1);
            met += answer.partitions.size();
        }
    }
    CHECK(met > 100);
}

TEST_CASE("ends that only rounding separates are one, but not by the rule that there is none",
          "[promise:coincidence]") {
    // A ball, and a box whose face all but touches it where the ray goes.
    const Scene scene = two_of(ball({0, 0, 0}, 1), box({1 + 1e-13, -1, -1}, {2, 1, 1}));
    const std::vector<Ray> ray = {{{-9, 0, 0}, {1, 0, 0}}};
    CHECK(shot(scene, "joined", by(Tolerance::surfaces), ray)[0].partitions.size() == 1);
    CHECK(shot(scene, "joined", by(Tolerance::none), ray)[0].partitions.size() == 2);
}

TEST_CASE("in BRL-CAD's files ends within 0.0005 mm are one, unless the rule is that of surfaces",
          "[promise:coincidence]") {
    const auto database = [](const char* gap) {
        const std::string text =
            std::string("title t\nunits mm\n") + "put a.s sph V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\n" +
            "put b.s arb8 V1 {2 -9 -9} V2 {3 -9 -9} V3 {3 9 -9} V4 {2 9 -9}" +
            " V5 {2 -9 9} V6 {3 -9 9} V7 {3 9 9} V8 {2 9 9}\n" + "put c.s arb8 V1 {" + gap +
            " -9 -9} V2 {5 -9 -9} V3 {5 9 -9} V4 {" + gap + " 9 -9} V5 {" + gap + " -9 9} V6 {5 -9 9} V7 {5 9 9} V8 {" +
            gap + " 9 9}\n" + "put r comb region yes tree {u {l b.s} {l c.s}}\n";
        return parse_scene(text, "gap.asc");
    };
    CHECK(database("3").tolerance == 0.0005);
    const std::vector<Ray> ray = {{{-9, 0, 0}, {1, 0, 0}}};
    CHECK(shot(database("3.0004"), "r", by(Tolerance::length), ray)[0].partitions.size() == 1);
    CHECK(shot(database("3.0006"), "r", by(Tolerance::length), ray)[0].partitions.size() == 2);
    CHECK(shot(database("3.0004"), "r", by(Tolerance::surfaces), ray)[0].partitions.size() == 2);
}
