// How large and how small numbers may be: within the limits answers are right, beyond them they are refused by name.
#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "integration/field/judge.hpp"
#include "oracle/random.hpp"
#include "integration/scenes.hpp"
#include "stress/build.hpp"
#include "thrown.hpp"

using namespace csgrt;
using namespace csgrt::stress;

namespace {

/// Regions of any shape in a ball of radius 40, all of it as large or as small as may be, or in between; rays with
/// directions as long or as short as may be.
StressScene scaled(std::uint64_t seed, std::size_t times) {
    Builder to("range", seed, times);
    Random& random = to.random();
    for (int i = random.whole(2, 4); i > 0; --i) {
        std::vector<std::string> solids;
        for (int k = random.whole(1, 3); k > 0; --k) solids.push_back(some_solid(to));
        to.region(some_tree(solids, random));
    }
    some_rays(to, 12, to.rays(20));
    StressScene made = to.take();
    constexpr double sizes[] = {Limits::length / 64, Limits::least_length, 1e10, 1e-10, 1, 1e6, 1e-6};
    const double by = sizes[seed % std::size(sizes)];
    for (Object& object : made.scene.objects) {
        auto* const region = std::get_if<Combination>(&object);
        if (region == nullptr) continue;
        for (TreeNode& node : region->tree.nodes)
            if (node.op == Operator::leaf) node.matrix = scaling(by);
    }
    constexpr double lengths[] = {1, 0x1p33, 0x1p-34, 1e20, 1e-20, 1e60, 1e-60};  // the oracle squares them
    std::size_t number = 0;
    for (Ray& ray : made.rays) {
        const double length = lengths[number++ % std::size(lengths)];
        ray.origin = by * ray.origin;
        ray.direction = length * ray.direction;
    }
    return made;
}

std::string refusal(const Scene& scene, const std::vector<std::string>& objects = {}) {
    return test::failure(Status::scene, [&] { Renderer(scene, objects, test::on_reference()); });
}
using test::says;

Scene one(Shape shape, const Matrix& matrix = identity) {
    Scene scene;
    scene.objects.push_back(Solid{"thing", std::move(shape), {}});
    Combination region{.name = "r", .region = true};
    region.tree = leaf("thing", matrix);
    scene.objects.push_back(std::move(region));
    return scene;
}

}  // namespace

TEST_CASE("answers are right up to the limits of sizes and of directions", "[field][promise:limits]") {
    test::judge_seeds(scaled, 1, 14, 1);
}
TEST_CASE("answers are right up to the limits on many rays", "[.long]") { test::judge_seeds(scaled, 101, 500, 10); }

TEST_CASE("a scene of every type answers the same, to the bit, 2^40 times as large or small", "[field]") {
    const std::string folder = test::folder("CSGRT_SCENES");
    if (folder.empty()) return;
    for (const char* name :
         {"solids", "cylinders", "polyhedra", "quadrics", "pipes", "blobs", "meshes", "sketches", "cells"}) {
        const Scene scene = load_scene(folder + "/" + name + ".json");
        const std::vector<std::string> tops = top_objects(scene);
        Settings settings = test::on_reference();
        Settings device_settings = test::on_device();
        settings.tolerance_rule = device_settings.tolerance_rule = Tolerance::surfaces;
        Renderer as_it_is(scene, {}, settings);
        const Box& box = as_it_is.model().bounds();
        const Vec3 low = box.low, high = box.high;
        const double size = std::hypot(high.x - low.x, high.y - low.y, high.z - low.z);
        stress::Random random(7);
        std::vector<Ray> rays;
        for (int i = 0; i < 300; ++i) {
            const Vec3 at{random.between(low.x, high.x), random.between(low.y, high.y), random.between(low.z, high.z)};
            const Vec3 d = i % 4 == 0 ? random.axis() : random.direction();
            rays.push_back({at - size * d, d});
        }
        const std::vector<RayPartitions> found = as_it_is.shoot(rays);
        int most = 0, least = 0;
        std::frexp(Limits::length / (4 * size), &most);
        std::frexp(Limits::least_length * 1e3, &least);
        for (const int exponent : {most - 1, least}) {
            INFO(name << " times 2^" << exponent);
            const double by = std::ldexp(1.0, exponent);
            Renderer other(moved(scene, tops, scaling(by)), {"moved"}, settings);
            std::vector<Ray> others = rays;
            for (Ray& ray : others) ray = {by * ray.origin, 0x1p-700 * ray.direction};
            std::vector<RayPartitions> answers = other.shoot(others);
            std::size_t hits = 0, different = 0;
            for (std::size_t i = 0; i < answers.size(); ++i) {
                const auto &a = found[i].partitions, &b = answers[i].partitions;
                hits += !a.empty();
                bool same = a.size() == b.size();
                for (std::size_t k = 0; same && k < a.size(); ++k)
                    same = a[k].region == b[k].region && std::ldexp(a[k].in, exponent + 700) == b[k].in &&
                           std::ldexp(a[k].out, exponent + 700) == b[k].out && a[k].in_normal == b[k].in_normal &&
                           a[k].out_normal == b[k].out_normal;
                different += !same;
            }
            CHECK(different == 0);
            CHECK(hits > 50);

            // Pictures, too: the same regions, counts and normals. Not the colours: lights stay where they are.
            std::optional<Renderer> device;
            if (name == std::string("solids"))
                device.emplace(moved(scene, tops, scaling(by)), std::vector<std::string>{"moved"}, device_settings);
            for (const double perspective : {0.0, 40.0}) {
                View view{.width = 40, .height = 40};
                view.camera.perspective = perspective;
                const Vec3 middle = 0.5 * (low + high);
                view.camera.center = middle;
                view.camera.view_size = size;
                const Image near = as_it_is.render(view);
                view.camera.center = by * middle;
                view.camera.view_size = by * size;
                const Image far = other.render(view);
                if (device) test::require_same(device->render(view), far);
                for (std::size_t c = 0; c < near.names.size(); ++c)
                    if (std::string("ZRGB").find(near.names[c]) == std::string::npos)
                        CHECK(std::ranges::equal(near.channels[c], far.channels[c]));
            }
        }
    }
}

TEST_CASE("what is beyond the limits is refused with the object, the value and the limit", "[field][promise:limits]") {
    const double large = Limits::length, small = Limits::least_length;
    CHECK(refusal(one(ball({0, 0, 0}, large))).empty());
    CHECK(refusal(one(ball({0, 0, 0}, small))).empty());
    const std::string far = refusal(one(ball({1e50, 0, 0}, 1)));
    CHECK(
        says(far, "solid 'thing': it has the number 1e+50; the largest size and distance from the origin is 1e+15 mm"));
    CHECK(says(refusal(one(ball({0, 0, 0}, 1), scaling(1e50))),
               "the matrix of 'thing' has the number 1e+50; the largest"));
    CHECK(says(refusal(one(ball({0, 0, 0}, 1e10), scaling(1e10))), "solid 'thing' reaches to 1e+20 mm"));
    CHECK(says(refusal(one(ball({1, 0, 0}, 1), scaling(1e-17))), "solid 'thing' is 3.46"));
    CHECK(says(refusal(one(ball({1, 0, 0}, 1), scaling(1e-17))), "the least size is 1e-15 mm"));
    CHECK(says(refusal(one(Half{{{0, 0, 1}, 1e10}}, scaling(1e10))), "solid 'thing' lies 1e+20 mm from the origin"));
    Scene nested = one(ball({0, 0, 0}, 1), scaling(1e15));
    for (int i = 0; i < 30; ++i) {  // what overflows on the way is refused, too
        Combination around;
        around.name = "c" + std::to_string(i);
        around.tree = leaf(i == 0 ? "r" : "c" + std::to_string(i - 1), scaling(1e15));
        nested.objects.push_back(std::move(around));
    }
    CHECK(says(refusal(nested, {"c29"}), "solid 'thing' reaches to "));
}

TEST_CASE("rays beyond the limits are refused with their number, the value and the limit", "[field][promise:limits]") {
    Renderer renderer(one(ball({0, 0, 0}, 1)), {}, test::on_reference());
    const auto refused = [&](const Ray& ray) {
        return test::failure(Status::usage, [&] { renderer.shoot({{{0, -9, 0}, {0, 1, 0}}, ray}); });
    };
    CHECK(refused({{0, 0, 0}, {0, Limits::greatest_direction, 0}}).empty());
    CHECK(refused({{0, 0, 0}, {0, 0, Limits::least_direction}}).empty());
    CHECK(refused({{Limits::ray_origin, 0, 0}, {1, 0, 0}}).empty());
    CHECK(says(refused({{0, 0, 0}, {0, 1e260, 0}}), "ray 1: the largest component of its direction is 1e+260"));
    CHECK(says(refused({{0, 0, 0}, {0, 1e-260, 0}}), "must be from 1e-250 to 1e+250"));
    CHECK(says(refused({{0, 2e18, 0}, {0, 1, 0}}),
               "ray 1: its origin has the coordinate 2e+18, and 1e+18 mm is the farthest"));
    CHECK(says(refused({{0, 2e18, 0}, {0, 0, 0}}), "ray 1: needs a direction other than 0"));
    CHECK(says(refused({{0, HUGE_VAL, 0}, {0, 1, 0}}), "ray 1: needs six finite numbers"));
}
