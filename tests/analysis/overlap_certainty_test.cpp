// What --certain promises, and the balls that a check excludes: overlaps of known size in awkward places.
#include <csgrt/check.hpp>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "bodies.hpp"
#include "catch.hpp"
#include "compile/model.hpp"
#include "thrown.hpp"

using namespace csgrt;
using test::leg, test::region, test::thrown_by, test::says;

namespace {

/// Pairs of regions, some 20 mm large and far from each other, whose overlaps are smaller.
struct Planted {
    Scene scene;
    std::vector<double> sizes;  ///< of each pair the diameter of the largest ball in its overlap
};

/// Two tetrahedra, on both sides of a point and far from it. A check has no distances to a mesh's surface, but to its
/// box, so it looks for overlaps of regions without this mesh by rays.
Bot far_beside(const Vec3& o) {
    Bot far;
    for (const double s : {-1.0, 1.0}) {
        const auto first = static_cast<std::uint32_t>(far.vertices.size());
        for (const Vec3& v : {Vec3{30, 30, 30}, Vec3{31, 30, 30}, Vec3{30, 31, 30}, Vec3{30, 30, 31}})
            far.vertices.push_back({o.x + s * v.x, o.y + s * v.y, o.z + s * v.z});
        for (const auto& face :
             {std::array{0u, 1u, 2u}, std::array{0u, 1u, 3u}, std::array{0u, 2u, 3u}, std::array{1u, 2u, 3u}})
            far.faces.push_back({first + face[0], first + face[1], first + face[2]});
    }
    return far;
}

Planted planted(int pairs, double least, double most, std::uint64_t seed, bool by_rays = true) {
    Planted all;
    std::mt19937_64 random(seed);
    const auto within = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
    };
    const auto direction = [&] {
        for (;;) {
            const Vec3 v = {within(-1, 1), within(-1, 1), within(-1, 1)};
            const double length = std::hypot(v.x, v.y, v.z);
            if (length > 0.1 && length < 1) return Vec3{v.x / length, v.y / length, v.z / length};
        }
    };
    const auto at = [](const Vec3& o, double s, const Vec3& d) {
        return Vec3{o.x + s * d.x, o.y + s * d.y, o.z + s * d.z};
    };
    /// A round rod along an axis through a point, between two distances from the point.
    const auto rod = [&](const Vec3& o, const Vec3& d, double from, double to, double r) {
        const Vec3 other = std::abs(d.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        const double along = other.x * d.x + other.y * d.y, height = to - from;
        const Vec3 side = at(other, -along, d);
        const double by = r / std::hypot(side.x, side.y, side.z);
        const Vec3 a = {by * side.x, by * side.y, by * side.z},
                   b = {d.y * a.z - d.z * a.y, d.z * a.x - d.x * a.z, d.x * a.y - d.y * a.x};
        return Tgc{at(o, from, d), {height * d.x, height * d.y, height * d.z}, a, b, a, b};
    };
    std::vector<TreeNode> legs;
    for (int i = 0; i < pairs; ++i) {
        const double size = i % 2 ? most : within(least, most), r = size / 2;
        const Vec3 o = {100.0 * (i % 10), 100.0 * (i / 10 % 10), 100.0 * (i / 100)};
        const std::string n = std::to_string(i), one = "one" + n, two = "two" + n, more = "more" + n;
        std::vector<TreeNode> first = {leg(one)}, second = {leg(two)};
        const auto add = [&](const std::string& name, const Shape& shape) {
            all.scene.objects.push_back(Solid{name, shape, {}});
        };
        if (i % 3 == 0) {  // two long oblique bars, whose axes meet
            add(one, rod(o, direction(), -within(1, 17), within(1, 17), r));
            add(two, rod(o, direction(), -within(1, 17), within(1, 17), r));
        } else if (i % 3 == 1) {  // the tip of a needle in the wall of a cavity
            add(one, rod(o, direction(), -6, 8 + size + 0.2, r));
            add(two, test::block({o.x - 11, o.y - 11, o.z - 11}, {o.x + 11, o.y + 11, o.z + 11}));
            add(more, test::ball_at(o, 8));
            second = {leg(two), leg(more), test::less};
        } else {  // a ball in a wall, beside which the ball's region has a plate
            const Vec3 c = {o.x + within(-7, 7), o.y + within(-7, 7), o.z + within(-7, 7)};
            add(one, test::ball_at(c, r));
            add(more, test::block({o.x - 10, o.y - 8, o.z - 8}, {o.x - 9.5, o.y + 8, o.z + 8}));
            add(two, test::block({o.x - 8, o.y - 8, o.z - 8}, {o.x + 8, o.y + 8, o.z + 8}));
            first = {leg(one), leg(more), test::either};
        }
        if (by_rays) {
            add("far" + n, far_beside(o));
            for (std::vector<TreeNode>* nodes : {&first, &second}) {
                nodes->push_back(leg("far" + n));
                nodes->push_back(test::less);
            }
        }
        all.scene.objects.push_back(region("first" + n, first, 2 * i + 1));
        all.scene.objects.push_back(region("second" + n, second, 2 * i + 2));
        all.scene.top.push_back("first" + n);
        all.scene.top.push_back("second" + n);
        all.sizes.push_back(size);
    }
    return all;
}

CheckResult checked(const Scene& scene, const CheckRequest& request, Settings settings = {.device = "native"},
                    const std::function<bool(const CheckResult&)>& look = {}) {
    return Checker(Model(scene, {}, settings), settings).check(request, look);
}

/// Number of pairs that are not listed, each of which may hold the ball that was planted.
std::size_t unlisted(const CheckResult& result, const Planted& p) {
    REQUIRE(result.candidates == p.sizes.size());
    REQUIRE(result.overlaps.size() + result.unlisted.size() == p.sizes.size());
    for (const FoundOverlap& o : result.overlaps) {
        REQUIRE(o.regions[1] == o.regions[0] + 1);
        CHECK(o.depth_at_most >= (1 - 1e-9) * p.sizes[o.regions[0] / 2]);
    }
    double before = HUGE_VAL;
    for (const UnlistedPair& pair : result.unlisted) {
        CAPTURE(pair.regions[0], pair.is_seen);
        CHECK(pair.depth_at_most >= (1 - 1e-9) * p.sizes[pair.regions[0] / 2]);
        CHECK(pair.depth_at_most <= before);
        before = pair.depth_at_most;
    }
    return result.unlisted.size();
}

}  // namespace

TEST_CASE("a check that is certain lists each pair whose overlap holds the ball, 1,000 of 1,000", "[promise:check]") {
    for (const std::uint64_t seed : {1, 2}) {
        const bool by_rays = seed == 1;
        const Planted p = planted(500, 0.45, 0.8, seed, by_rays);
        CheckRequest request{.min_depth = 0.2, .effort = 1e-4, .seed = seed};
        const std::size_t missed = unlisted(checked(p.scene, request), p);
        request.certain = 0.8;
        const CheckResult result = checked(p.scene, request);
        CAPTURE(seed, missed, unlisted(result, p));
        if (by_rays) CHECK(missed > 50);
        for (const UnlistedPair& pair : result.unlisted) CHECK(pair.depth_at_most < request.certain);
        CHECK(result.rays_to_come == 0);
    }
}

TEST_CASE("what a check excludes gets smaller with certainty, on all devices and threads alike", "[promise:bits]") {
    const Planted p = planted(60, 0.05, 0.8, 3);
    const auto bytes_of = [](const CheckResult& result) {
        std::string bytes = std::to_string(result.rays) + " " + std::to_string(result.overlaps.size());
        for (const UnlistedPair& pair : result.unlisted)
            for (const double value : {double(pair.regions[0]), double(pair.is_seen), pair.depth_at_most})
                bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
        return bytes;
    };
    const CheckRequest request{.min_depth = 0.2, .certain = 0.4, .effort = 1e-4};
    const CheckResult one = checked(p.scene, request, {.device = "native", .threads = 1});
    CHECK(unlisted(one, p) > 0);
    CHECK(bytes_of(checked(p.scene, request, {.device = "native", .threads = 3})) == bytes_of(one));
    CHECK(bytes_of(checked(p.scene, request, {.reference = true})) == bytes_of(one));
}

TEST_CASE("a check says what certainty costs before it begins, and keeps what it has if it is ended then") {
    const Planted p = planted(60, 0.05, 0.8, 4);
    CheckRequest request{.min_depth = 0.1, .effort = 1e-4};
    const CheckResult before = checked(p.scene, request);
    request.certain = 0.1;
    std::uint64_t said = 0;
    const CheckResult result = checked(p.scene, request, {.device = "native"}, [&](const CheckResult& so_far) {
        said = so_far.rays_to_come;
        return said == 0;
    });
    CHECK_FALSE(result.is_complete);
    CHECK(said == result.rays_to_come);
    CHECK(said > 1000);
    CHECK(before.unlisted.front().depth_at_most < 5);  // two cells in 20 mm, with rays 2.8 mm apart
    CHECK(result.rays == before.rays);
    REQUIRE(!result.unlisted.empty());
    CHECK(result.unlisted.front().depth_at_most == before.unlisted.front().depth_at_most);
}

TEST_CASE("a shallow overlap is listed for certainty where its rays exclude no ball", "[promise:check]") {
    Scene scene;
    for (const auto& [name, shape] : {std::pair<const char*, Shape>("body", test::block({-60, -60, -30}, {60, 60, 30})),
                                      {"hole", test::round_rod(20, 200)},
                                      {"shaft", test::round_rod(20.01, 150)}})
        scene.objects.push_back(Solid{name, shape, {}});
    scene.objects.push_back(region("first", {leg("body"), leg("hole"), test::less}, 1));
    scene.objects.push_back(region("second", {leg("shaft")}, 2));
    scene.top = {"first", "second"};
    const CheckResult result = checked(scene, {.min_depth = 0.1});
    CHECK((result.overlaps.empty() && result.shallow == 1));
    REQUIRE(result.unlisted.size() == 1);
    CHECK(result.unlisted.front().is_seen);
    const CheckResult certain = checked(scene, {.min_depth = 0.1, .certain = 0.5});
    REQUIRE(certain.overlaps.size() == 1);
    const FoundOverlap& o = certain.overlaps.front();
    CAPTURE(o.depth, o.depth_at_most);
    CHECK((certain.unlisted.empty() && certain.shallow == 1));
    CHECK((o.depth < 0.05 && o.depth_at_most >= 0.5 && !o.is_near_limit));
    CHECK(certain.new_overlaps == 0);
    const CheckResult coarse =
        checked(scene, {.min_depth = 0.1, .certain = 20});  // a ball that no ring this thin holds
    CHECK(coarse.overlaps.empty());
}

TEST_CASE("certainty that cannot be had is refused, with what can") {
    Scene scene = planted(3, 0.5, 0.8, 5).scene;
    const auto refused = [&](const CheckRequest& request, const std::string& text) {
        CAPTURE(text);
        CHECK(says(thrown_by([&] { checked(scene, request); }).text, text));
    };
    refused({.min_depth = 0.1, .certain = 0.05}, "at least the least depth");
    refused({.certain = -1}, "at least the least depth");
    refused({.certain = HUGE_VAL}, "at least the least depth");
    refused({.min_depth = 1e-6, .certain = 1e-6}, "1e+12 are the most: ");
    scene.tolerance = 0.0005;
    refused({.min_depth = 1e-3, .certain = 2e-3}, "may not be seen, so at least 0.00235 mm");
}
