// The checker through the library: what may not change the answer, and what is told. check_test.py looks at depths and
// contact.
#include <csgrt/check.hpp>

#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "bodies.hpp"
#include "catch.hpp"
#include "compile/model.hpp"
#include "thrown.hpp"

using namespace csgrt;
using test::ball, test::leg, test::region, test::solid, test::thrown_by, test::says;

namespace {

Settings on_native() { return {.device = "native"}; }

CheckResult checked(const Scene& scene, const CheckRequest& request, const Settings& settings = on_native()) {
    return Checker(Model(scene, {}, settings), settings).check(request);
}

/// Two regions, turned and moved, so that nothing lies along an axis.
Scene turned(std::vector<Solid> solids, std::vector<TreeNode> first, std::vector<TreeNode> second) {
    const double ca = std::cos(0.7), sa = std::sin(0.7), cb = std::cos(0.4), sb = std::sin(0.4);
    const Matrix place = {ca, -sa * cb, sa * sb, 30, sa, ca * cb, -ca * sb, -20, 0, sb, cb, 50, 0, 0, 0, 1};
    Scene scene;
    for (Solid& each : solids) scene.objects.push_back(std::move(each));
    scene.objects.push_back(region("first", std::move(first), 1001));
    scene.objects.push_back(region("second", std::move(second), 1002));
    scene.objects.push_back(test::group("all", {leg("first", place), leg("second", place), test::either}));
    scene.top = {"all"};
    return scene;
}

/// Two balls that overlap by that much.
Scene balls(double by) { return turned({ball("a", {}, 50), ball("b", {100 - by, 0, 0}, 50)}, {leg("a")}, {leg("b")}); }

std::string bytes_of(const CheckResult& result) {
    std::string bytes = std::to_string(result.rays) + " " + std::to_string(result.shallow);
    for (const FoundOverlap& o : result.overlaps)
        for (const double value : {double(o.regions[0]), double(o.regions[1]), o.place.x, o.place.y, o.place.z, o.depth,
                                   o.depth_at_most, o.volume.value, o.volume.half_width, o.t_in, o.t_out, o.box.low.x,
                                   o.box.high.z, o.ray.origin.x, o.ray.direction.y})
            bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    return bytes;
}

}  // namespace

TEST_CASE("the volume of an overlap is that of the lens of two balls") {
    const double h = 5, lens = 2 * std::numbers::pi * h * h * (3 * 50 - h) / 3;
    const CheckResult result = checked(balls(2 * h), {});
    REQUIRE(result.overlaps.size() == 1);
    const Estimate& volume = result.overlaps.front().volume;
    CAPTURE(volume.value, volume.half_width, lens);
    CHECK(std::abs(volume.value - lens) <= 2 * volume.half_width);
    CHECK(volume.half_width < 0.2 * lens);
}

TEST_CASE("devices and threads change no bit of a check, and a seed changes its rays", "[promise:bits]") {
    const Scene scene = balls(0.01);  // which is found in cells
    Settings one = on_native(), three = on_native();
    one.threads = 1;
    three.threads = 3;
    const std::string expected = bytes_of(checked(scene, {}, one));
    CHECK(bytes_of(checked(scene, {}, three)) == expected);
    CHECK(bytes_of(checked(scene, {}, {.reference = true})) == expected);
    CHECK(bytes_of(checked(scene, {.seed = 2}, one)) != expected);
}

TEST_CASE("allowed overlaps are marked, by patterns in either order, and rows without use are told") {
    const auto with = [](std::vector<AllowedOverlap> rows) { return checked(balls(2), {.allowed = std::move(rows)}); };
    CHECK(with({}).new_overlaps == 1);
    for (const auto& [a, b] : {std::pair("/all/first", "/all/second"), {"*second", "/all/f*"}, {"/all", "*"}}) {
        const CheckResult result = with({{a, b}, {"/other", "*"}});
        CHECK(result.new_overlaps == 0);
        REQUIRE(result.overlaps.size() == 1);
        CHECK(result.overlaps.front().is_allowed);
        REQUIRE(result.unused.size() == 1);
        CHECK(result.unused.front().first == "/other");
    }
    CHECK(with({{"/all/firs", "/all/second"}}).new_overlaps == 1);
}

TEST_CASE("shallow overlaps are counted, and those near the limit marked") {
    const CheckResult deep = checked(balls(0.5), {.min_depth = 2});
    CHECK((deep.overlaps.empty() && deep.shallow == 1));
    const CheckResult near = checked(balls(0.5), {.min_depth = 0.4});
    REQUIRE(near.overlaps.size() == 1);
    const FoundOverlap& o = near.overlaps.front();
    CHECK(o.is_near_limit);
    const Vec3 middle = {o.place.x - o.ray.origin.x, o.place.y - o.ray.origin.y, o.place.z - o.ray.origin.z};
    const double along = middle.x * o.ray.direction.x + middle.y * o.ray.direction.y + middle.z * o.ray.direction.z;
    CHECK(std::hypot(middle.x - along * o.ray.direction.x, middle.y - along * o.ray.direction.y,
                     middle.z - along * o.ray.direction.z) < 1e-9);  // the ray goes through the place
    CHECK((o.t_in <= along && along <= o.t_out));
}

TEST_CASE("a region without an end is searched within the box of the others, and told") {
    Scene scene = turned({solid("half", Half{{{0, 0, 1}, -20}}), ball("b", {}, 30)}, {leg("half")}, {leg("b")});
    const CheckResult result = checked(scene, {});
    REQUIRE(result.overlaps.size() == 1);
    CHECK(result.unbounded == std::vector<std::uint32_t>{result.overlaps.front().regions[0]});
    CHECK(std::abs(result.overlaps.front().depth - 10) < 0.5);
}

TEST_CASE("a check that is told to stop keeps what it has") {
    Settings settings = on_native();
    int calls = 0;
    settings.progress = [&](double) { return ++calls < 3; };
    Checker checker(Model(balls(2), {}, on_native()), settings);
    CHECK_FALSE(checker.check().is_complete);
}

TEST_CASE("requests that mean nothing are refused") {
    Checker checker(Model(balls(2), {}, on_native()), on_native());
    CHECK(says(thrown_by([&] { checker.check({.min_depth = 0}); }).text, "least depth"));
    CHECK(says(thrown_by([&] { checker.check({.effort = 1e4}); }).text, "effort"));
}

TEST_CASE("a region of air gives way, so it overlaps no solid") {
    Scene scene = balls(10);
    std::get<Combination>(scene.objects[3]).air = 1;
    Settings settings = on_native();
    settings.air = true;
    const Model model(scene, {}, settings);
    REQUIRE(model.regions().size() == 2);
    CHECK(Checker(model, settings).check().overlaps.empty());
}

TEST_CASE("the bound of a blade's depth is not below it, however thin the blade is", "[promise:check]") {
    for (const double half : {1e-2, 3e-3, 1e-4, 1e-6}) {
        const Scene scene = turned({solid("blade", Ell{{}, {1000, 0, 0}, {0, 500, 0}, {0, 0, half}}),
                                    test::block("around", {-10, -10, -10}, {10, 10, 10})},
                                   {leg("blade")}, {leg("around")});
        const CheckResult result = checked(scene, {.min_depth = half, .certain = half > 1e-5 ? 1.9 * half : 0});
        CAPTURE(half);
        REQUIRE(result.overlaps.size() == 1);
        const FoundOverlap& o = result.overlaps.front();
        CAPTURE(o.depth, o.depth_at_most);
        CHECK((o.depth <= 2 * half * (1 + 1e-6) && o.depth > 1.9 * half));
        CHECK(o.depth_at_most >= 2 * half * (1 - 1e-6));
    }
}

TEST_CASE("equal regions, all in one place, overlap pair by pair; an empty one overlaps nothing and has an end") {
    Scene scene = test::scene({ball("a", {}, 10), ball("far", {100, 0, 0}, 1)});
    std::vector<std::string>& top = scene.top;
    for (int i = 0; i < 12; ++i) {
        top.push_back("r" + std::to_string(i));
        scene.objects.push_back(region(top.back(), {leg("a")}));
    }
    scene.objects.push_back(region("empty", {leg("a"), leg("far"), test::both}));
    top.push_back("empty");
    const CheckResult result = checked(scene, {});
    CHECK(result.overlaps.size() == 12 * 11 / 2);
    CHECK(result.unbounded.empty());
    for (const FoundOverlap& o : result.overlaps) CHECK(std::abs(o.depth - 20) < 1e-6);
}
