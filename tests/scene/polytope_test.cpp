// The corners of intersected half-spaces: counts and places known from geometry.
#include "catch.hpp"

#include <cmath>
#include <random>

#include "scene/solids/polytope.hpp"
#include "scene/vector.hpp"

using namespace csgrt;

namespace {

std::vector<Plane> cube_planes(double half, const Vec3& center = {}) {
    std::vector<Plane> planes;
    for (const Vec3& n :
         {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}}) {
        planes.push_back({n, half + dot(n, center)});
    }
    return planes;
}

std::size_t distinct(std::vector<Vec3> points, double gap) {
    std::size_t count = 0;
    while (!points.empty()) {
        const Vec3 p = points.back();
        std::erase_if(points, [&](const Vec3& q) { return length(p - q) <= gap; });
        ++count;
    }
    return count;
}

}  // namespace

TEST_CASE("polytope: a cube has eight corners, near and far") {
    for (const Vec3& center : {Vec3{}, Vec3{1e6, -3e6, 2e6}}) {
        const Polytope cube = intersect_half_spaces(cube_planes(2, center));
        REQUIRE(cube.kind == Polytope::Kind::bounded);
        CHECK(distinct(cube.vertices, 1e-6) == 8);
        for (const Vec3& p : cube.vertices) {
            CHECK(std::abs(std::abs(p.x - center.x) - 2) < 1e-8);
            CHECK(std::abs(std::abs(p.y - center.y) - 2) < 1e-8);
            CHECK(std::abs(std::abs(p.z - center.z) - 2) < 1e-8);
        }
    }
}

TEST_CASE("polytope: a tetrahedron, an octahedron, planes that say nothing new") {
    const double s = 1 / std::sqrt(3.0);
    std::vector<Plane> tetrahedron = {{{s, s, s}, 1}, {{s, -s, -s}, 1}, {{-s, s, -s}, 1}, {{-s, -s, s}, 1}};
    CHECK(distinct(intersect_half_spaces(tetrahedron).vertices, 1e-9) == 4);
    tetrahedron.push_back({{1, 0, 0}, 100});  // does not touch it
    tetrahedron.push_back({{s, s, s}, 1});    // stands there already
    CHECK(distinct(intersect_half_spaces(tetrahedron).vertices, 1e-9) == 4);

    std::vector<Plane> octahedron;
    for (int i = 0; i < 8; ++i) octahedron.push_back({{i & 1 ? s : -s, i & 2 ? s : -s, i & 4 ? s : -s}, 1});
    const Polytope result = intersect_half_spaces(octahedron);
    REQUIRE(result.kind == Polytope::Kind::bounded);
    CHECK(distinct(result.vertices, 1e-9) == 6);
}

TEST_CASE("polytope: unbounded ones") {
    CHECK(intersect_half_spaces({}).kind == Polytope::Kind::unbounded);
    CHECK(intersect_half_spaces({{{1, 0, 0}, 1}}).kind == Polytope::Kind::unbounded);
    for (std::size_t open = 0; open < 6; ++open) {
        std::vector<Plane> planes = cube_planes(1);
        planes.erase(planes.begin() + static_cast<std::ptrdiff_t>(open));
        CHECK(intersect_half_spaces(planes).kind == Polytope::Kind::unbounded);
    }
}

TEST_CASE("polytope: empty ones, and flat ones") {
    std::vector<Plane> apart = cube_planes(1);
    apart[1].distance = -2;  // x <= 1 and x >= 2
    CHECK(intersect_half_spaces(apart).kind == Polytope::Kind::empty);
    std::vector<Plane> flat = cube_planes(1);
    flat[1].distance = -1;  // x <= 1 and x >= 1
    CHECK(intersect_half_spaces(flat).kind == Polytope::Kind::empty);
    const double s = 1 / std::sqrt(3.0);
    std::vector<Plane> slanted = cube_planes(1);
    slanted.push_back({{s, s, s}, 0.25});
    slanted.push_back({{-s, -s, -s}, -0.25});
    CHECK(intersect_half_spaces(slanted).kind == Polytope::Kind::empty);
}

TEST_CASE("polytope: slivers have an inside") {
    for (const double thickness : {1e-3, 1e-6, 1e-9}) {
        std::vector<Plane> plate = cube_planes(100);
        plate[4].distance = thickness;
        plate[5].distance = 0;
        INFO(thickness);
        CHECK(intersect_half_spaces(plate).kind == Polytope::Kind::bounded);
    }
}

TEST_CASE("polytope: planes around a sphere, each corner on three of them and below all") {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::vector<Plane> planes;
    for (int i = 0; i < 200; ++i) planes.push_back({unit({normal(random), normal(random), normal(random)}), 5});
    const Polytope ball = intersect_half_spaces(planes);
    REQUIRE(ball.kind == Polytope::Kind::bounded);
    for (const Vec3& p : ball.vertices) {
        int on = 0;
        for (const Plane& plane : planes) {
            const double distance = dot(plane.normal, p) - plane.distance;
            REQUIRE(distance < 1e-9);
            on += distance > -1e-9;
        }
        REQUIRE(on >= 3);
    }
    // A simple polytope of F faces has 2 F - 4 corners (Euler).
    CHECK(distinct(ball.vertices, 1e-9) == 2 * 200 - 4);
}
