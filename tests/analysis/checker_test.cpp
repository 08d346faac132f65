// The checker through the library: planted overlaps of known depth, contact, and what may not change the answer.
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
using test::ball, test::block, test::leg, test::region, test::solid, test::thrown_by, test::says;

namespace {

Settings on_native() { return {.device = "native"}; }

CheckResult checked(const Scene& scene, const CheckRequest& request, const Settings& settings = on_native()) {
    return Checker(Model(scene, {}, settings), settings).check(request);
}

/// Two regions, turned and moved, so that nothing lies along an axis.
Scene turned(std::vector<Solid> solids, std::vector<TreeNode> first, std::vector<TreeNode> second, double angle = 0.7) {
    const double ca = std::cos(angle), sa = std::sin(angle), cb = std::cos(0.4), sb = std::sin(0.4);
    const Matrix place = {ca, -sa * cb, sa * sb, 30, sa, ca * cb, -ca * sb, -20, 0, sb, cb, 50, 0, 0, 0, 1};
    Scene scene;
    for (Solid& each : solids) scene.objects.push_back(std::move(each));
    scene.objects.push_back(region("first", std::move(first), 1001));
    scene.objects.push_back(region("second", std::move(second), 1002));
    scene.objects.push_back(test::group("all", {leg("first", place), leg("second", place), test::either}));
    scene.top = {"all"};
    return scene;
}

/// Two regions that overlap, of some 100 mm.
struct Planted {
    std::string kind;
    Scene scene;
    double depth;  ///< the diameter of the largest ball in the overlap
};

/// The overlaps reach `by` into the other region.
std::vector<Planted> planted(double by) {
    const Solid plate = block("plate", {-100, -100, -20}, {100, 100, 0}),
                hole = solid("hole", test::round_rod(20, 200));
    const auto pair = [](const std::string& kind, const Solid& a, const Solid& b, double depth) {
        return Planted{kind, turned({a, b}, {leg(a.name)}, {leg(b.name)}), depth};
    };
    const double root = std::sqrt(0.5), third = std::sqrt(1.0 / 3);
    // A cube on its corner: its three edges from the corner rise at equal angles.
    const Vec3 e[3] = {
        {std::sqrt(2.0 / 3), 0, third}, {-std::sqrt(1.0 / 6), root, third}, {-std::sqrt(1.0 / 6), -root, third}};
    const auto corner = [&](double x, double y, double z) {
        return Vec3{x * e[0].x + y * e[1].x + z * e[2].x, x * e[0].y + y * e[1].y + z * e[2].y,
                    x * e[0].z + y * e[1].z + z * e[2].z - by};
    };
    const Arb cube{{corner(0, 0, 0), corner(60, 0, 0), corner(60, 60, 0), corner(0, 60, 0), corner(0, 0, 60),
                    corner(60, 0, 60), corner(60, 60, 60), corner(0, 60, 60)}};
    const Tgc cone{{0, 0, 100 - by}, {0, 0, -100}, {50, 0, 0}, {0, 50, 0}, {1e-6, 0, 0}, {0, 1e-6, 0}};
    const double sine = 50 / std::hypot(50, 100);
    std::vector<Planted> all = {
        pair("faces", plate, block("box", {-40, -30, -by}, {40, 30, 60}), by),
        pair("corner in a plate", plate, solid("cube", cube), 2 * by * third / (1 + third)),
        pair("cone's tip", plate, solid("cone", cone), 2 * by * sine / (1 + sine)),
        pair("balls", ball("a", {}, 50), ball("b", {100 - by, 0, 0}, 50), by),
        pair("torus", plate, solid("torus", Tor{{0, 0, 10 - by}, {0, 0, 1}, 40, 10}), by),
        pair("long bar", plate, block("bar", {-95, -1, -by}, {95, 1, 2}), std::min(by, 2.0)),
    };
    all.push_back(
        {"shaft in a hole",
         turned({block("body", {-60, -60, -30}, {60, 60, 30}), hole, solid("shaft", test::round_rod(20 + by, 200))},
                {leg("body"), leg("hole"), test::less}, {leg("shaft")}),
         by});
    all.push_back(
        {"ball in a socket",
         turned({block("body", {-60, -60, -60}, {60, 60, 0}), ball("socket", {}, 40), ball("ball", {0, 0, -by}, 40)},
                {leg("body"), leg("socket"), test::less}, {leg("ball")}),
         by});
    return all;
}

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

TEST_CASE("planted overlaps are found, and their largest ball is between the two depths", "[promise:overlap]") {
    for (const double by : {8.0, 0.5}) {
        for (const Planted& p : planted(by)) {
            CAPTURE(p.kind, by, p.depth);
            const CheckResult result = checked(p.scene, {.min_depth = 0.1 * p.depth});
            REQUIRE(result.overlaps.size() == 1);
            const FoundOverlap& found = result.overlaps.front();
            CAPTURE(found.depth, found.depth_at_most);
            CHECK(found.depth <= 1.02 * p.depth);
            CHECK(found.depth >= 0.8 * p.depth);
            CHECK(found.depth_at_most >= (1 - 1e-9) * p.depth);
            CHECK(found.t_out - found.t_in >= 0.8 * p.depth);
            CHECK_FALSE(found.is_near_limit);
        }
    }
}

TEST_CASE("the volume of an overlap is that of the lens of two balls") {
    const double h = 5, lens = 2 * std::numbers::pi * h * h * (3 * 50 - h) / 3;
    const CheckResult result =
        checked(turned({ball("a", {}, 50), ball("b", {90, 0, 0}, 50)}, {leg("a")}, {leg("b")}), {});
    REQUIRE(result.overlaps.size() == 1);
    const Estimate& volume = result.overlaps.front().volume;
    CAPTURE(volume.value, volume.half_width, lens);
    CHECK(std::abs(volume.value - lens) <= 2 * volume.half_width);
    CHECK(volume.half_width < 0.2 * lens);
}

TEST_CASE("contact is no overlap, from whichever side", "[promise:overlap]") {
    for (int i = 0; i < 12; ++i) {
        const double angle = 0.1 + 0.5 * i;
        const Scene faces = turned({block("a", {0, 0, -20}, {50, 40, 0}), block("b", {10, 10, 0}, {70, 30, 9})},
                                   {leg("a")}, {leg("b")}, angle);
        const Scene shaft = turned({block("body", {-60, -60, -30}, {60, 60, 30}),
                                    solid("hole", test::round_rod(20, 200)), solid("shaft", test::round_rod(20, 150))},
                                   {leg("body"), leg("hole"), test::less}, {leg("shaft")}, angle);
        const Scene balls = turned({ball("a", {}, 50), ball("b", {100, 0, 0}, 50)}, {leg("a")}, {leg("b")}, angle);
        for (const Scene& scene : {faces, shaft, balls}) {
            const CheckResult result = checked(scene, {.min_depth = 1e-6, .seed = std::uint64_t(i + 1)});
            CHECK(result.overlaps.empty());
            CHECK(result.candidates == 1);
        }
    }
}

TEST_CASE("devices and threads change no bit of a check, and a seed changes its rays", "[promise:bits]") {
    const Planted p = planted(2.0)[1];
    Settings one = on_native(), three = on_native();
    one.threads = 1;
    three.threads = 3;
    const std::string expected = bytes_of(checked(p.scene, {}, one));
    CHECK(bytes_of(checked(p.scene, {}, three)) == expected);
    CHECK(bytes_of(checked(p.scene, {}, {.reference = true})) == expected);
    CHECK(bytes_of(checked(p.scene, {.seed = 2}, one)) != expected);
}

TEST_CASE("allowed overlaps are marked, by patterns in either order, and rows without use are told") {
    const Planted p = planted(2.0)[0];
    const auto with = [&](std::vector<AllowedOverlap> rows) { return checked(p.scene, {.allowed = std::move(rows)}); };
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
    const Planted p = planted(0.5)[0];
    const CheckResult deep = checked(p.scene, {.min_depth = 2});
    CHECK((deep.overlaps.empty() && deep.shallow == 1));
    const CheckResult near = checked(p.scene, {.min_depth = 0.4});
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
    Checker checker(Model(planted(2.0)[0].scene, {}, on_native()), settings);
    CHECK_FALSE(checker.check().is_complete);
}

TEST_CASE("requests that mean nothing are refused") {
    Checker checker(Model(planted(2.0)[0].scene, {}, on_native()), on_native());
    CHECK(says(thrown_by([&] { checker.check({.min_depth = 0}); }).text, "least depth"));
    CHECK(says(thrown_by([&] { checker.check({.effort = 1e4}); }).text, "effort"));
}
