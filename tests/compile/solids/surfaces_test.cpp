// Which curved surfaces are one, and what a ray sees of it.
#include <cmath>

#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "compile/compiled_scene.hpp"

using namespace csgrt;

namespace {

Scene scene_of(const std::vector<Shape>& shapes) {
    Scene scene;
    for (const Shape& shape : shapes)
        scene.objects.push_back(Solid{"s" + std::to_string(scene.objects.size()), shape, {}});
    return scene;
}

/// Do the two have the same numbers? (They are boxed and sorted, so which is first does not matter.)
bool are_one(const Shape& a, const Shape& b) {
    const CompiledScene scene = compile(scene_of({a, b}), {}, {});
    REQUIRE(scene.solids.size() == 2);
    return scene.solids[0].first_real == scene.solids[1].first_real;
}

/// A frustum between two points of the line p + s d.
Tgc frustum(const Vec3& p, const Vec3& d, double from, double to, double r_from, double r_to) {
    const double length = std::hypot(d.x, d.y, d.z);
    const Vec3 u{d.x / length, d.y / length, d.z / length};
    const Vec3 side = std::fabs(u.z) < 0.9 ? Vec3{-u.y, u.x, 0} : Vec3{0, -u.z, u.y};
    const double across = std::hypot(side.x, side.y, side.z);
    const Vec3 a{side.x / across, side.y / across, side.z / across};
    const Vec3 b{u.y * a.z - u.z * a.y, u.z * a.x - u.x * a.z, u.x * a.y - u.y * a.x};
    const auto times = [](double s, const Vec3& v) { return Vec3{s * v.x, s * v.y, s * v.z}; };
    const Vec3 base{p.x + from * u.x, p.y + from * u.y, p.z + from * u.z};
    return {base, times(to - from, u), times(r_from, a), times(r_from, b), times(r_to, a), times(r_to, b)};
}

}  // namespace

TEST_CASE("balls of one centre and radius are one, however their axes are turned", "[compile][promise:coincidence]") {
    const Ell ball{{1, 2, 3}, {5, 0, 0}, {0, 5, 0}, {0, 0, 5}}, turned{{1, 2, 3}, {0, 3, 4}, {0, -4, 3}, {5, 0, 0}};
    CHECK(are_one(ball, turned));
    CHECK_FALSE(are_one(ball, Ell{{1, 2, 3 + 1e-7}, {5, 0, 0}, {0, 5, 0}, {0, 0, 5}}));
    CHECK_FALSE(are_one(ball, Ell{{1, 2, 3}, {5 + 1e-7, 0, 0}, {0, 5 + 1e-7, 0}, {0, 0, 5 + 1e-7}}));
    CHECK_FALSE(are_one(ball, Ell{{1, 2, 3}, {5, 0, 0}, {0, 5, 0}, {0, 0, 4}}));
}

TEST_CASE("cylinders and cones of one side are one, whatever their lengths and the way they run",
          "[compile][promise:coincidence]") {
    const Vec3 p{3, -1, 2}, d{1, 2, 2}, back{-1, -2, -2};
    CHECK(are_one(frustum(p, d, 0, 10, 2, 2), frustum(p, d, 4, 7, 2, 2)));
    CHECK(are_one(frustum(p, d, 0, 10, 2, 2), frustum(p, back, -30, -20, 2, 2)));
    CHECK(are_one(frustum(p, d, 0, 10, 1, 2), frustum(p, d, 2, 5, 1.2, 1.5)));
    CHECK(are_one(frustum(p, d, 0, 10, 2, 1), frustum(p, back, -20, 0, 0, 2)));  // the second has an apex
    CHECK_FALSE(are_one(frustum(p, d, 0, 10, 2, 2), frustum(p, d, 4, 7, 2.0000001, 2.0000001)));
    CHECK_FALSE(are_one(frustum(p, d, 0, 10, 1, 2), frustum(p, d, 0, 10, 2, 1)));
    CHECK_FALSE(are_one(frustum(p, d, 0, 10, 0, 2), frustum(p, d, -10, 0, 2, 0)));  // tip to tip
    CHECK_FALSE(are_one(frustum(p, d, 0, 10, 2, 2), frustum(p, {2, 1, 2}, 0, 10, 2, 2)));
}

TEST_CASE("tori of one centre, plane and radii are one", "[compile][promise:coincidence]") {
    CHECK(are_one(Tor{{1, 2, 3}, {0, 0, 1}, 5, 2}, Tor{{1, 2, 3}, {0, 0, -4}, 5, 2}));
    CHECK_FALSE(are_one(Tor{{1, 2, 3}, {0, 0, 1}, 5, 2}, Tor{{1, 2, 3}, {0, 0, 1}, 5, 2.0000001}));
    CHECK_FALSE(are_one(Tor{{1, 2, 3}, {0, 0, 1}, 5, 2}, Tor{{1, 2, 3}, {0, 1e-6, 1}, 5, 2}));
}

TEST_CASE("what shares a side leaves no skin, with no tolerance at all", "[compile][promise:coincidence]") {
    const Vec3 p{3, -1, 2}, d{1, 2, 2};
    Scene scene = scene_of({frustum(p, d, 0, 10, 2, 2), frustum(p, d, -1, 11, 2, 2), frustum(p, d, 2, 3, 2, 2)});
    Combination nothing, ring;
    nothing.name = "nothing";
    ring.name = "ring";
    const auto leaf = [](const char* name) { return TreeNode{Operator::leaf, 0, name, identity, {}}; };
    nothing.region = ring.region = true;
    nothing.tree.nodes = {leaf("s0"), leaf("s1"), {Operator::difference, 2, {}, identity, {}}};
    ring.tree.nodes = {leaf("s0"), leaf("s2"), {Operator::difference, 2, {}, identity, {}}};
    scene.objects.push_back(nothing);
    scene.objects.push_back(ring);
    Settings settings{.reference = true, .tolerance_rule = Tolerance::none};
    std::vector<Ray> across;
    for (int i = 0; i < 400; ++i)
        across.push_back(
            {{20 + 0.01 * i, 30 - 0.07 * i, -10 + 0.03 * i}, {-17 + 0.001 * i, -30 + 0.08 * i, 14 - 0.02 * i}});
    std::size_t hits = 0;
    for (const RayPartitions& ray : Renderer(scene, {"ring"}, settings).shoot(across)) {
        hits += ray.partitions.empty() ? 0 : 1;
        for (const Partition& part : ray.partitions) CHECK(part.out - part.in > 1e-9);
    }
    CHECK(hits > 50);
    for (const RayPartitions& ray : Renderer(scene, {"nothing"}, settings).shoot(across)) CHECK(ray.partitions.empty());
}
