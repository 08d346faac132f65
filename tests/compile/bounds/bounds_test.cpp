// Boxes: tight around points of the surface, BRL-CAD's where they differ, and the rules for trees.
#include <algorithm>
#include <random>

#include "catch.hpp"
#include "compile/bounds/bounds.hpp"
#include "compile/linear.hpp"
#include "compile/model.hpp"
#include "compile/solids/polyhedron.hpp"
#include "sanitized.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

constexpr double pi = 3.14159265358979323846;

Vec3 at(const Matrix& m, const Wide& p) { return narrow(transform_point(m, p)); }

bool inside(const Box& box, const Vec3& p) {
    return box.low.x <= p.x && p.x <= box.high.x && box.low.y <= p.y && p.y <= box.high.y && box.low.z <= p.z &&
           p.z <= box.high.z;
}
bool inside(const Box& box, const Box& inner) { return inside(box, inner.low) && inside(box, inner.high); }
bool same(const Box& a, const Box& b, double slack) {
    const auto close = [&](const Vec3& p, const Vec3& q) {
        return near(p.x, q.x, slack) && near(p.y, q.y, slack) && near(p.z, q.z, slack);
    };
    return close(a.low, b.low) && close(a.high, b.high);
}

struct Random {
    std::mt19937 engine{7};
    double operator()(double low = -1, double high = 1) {
        return std::uniform_real_distribution<double>(low, high)(engine);
    }
    Wide wide() { return {(*this)(), (*this)(), (*this)()}; }
    /// Rotation, shear, stretch, perhaps a mirror.
    Matrix matrix() {
        const Vec3 place{(*this)(-50, 50), (*this)(-50, 50), (*this)(-50, 50)};
        Matrix m = askew((*this)(0, 6), place);
        for (const std::size_t i : {0, 1, 2, 4, 5, 6, 8, 9, 10}) m[i] += 0.4 * (*this)();
        return m;
    }
};

/// The box around many points of the surface, which the solid's box must hold, and not by much more than it.
template <class Point>
Box sampled(const Matrix& m, const Point& point, int steps = 400) {
    Box box = empty_box;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j <= steps; ++j) extend(box, at(m, point(2 * pi * i / steps, static_cast<double>(j) / steps)));
    return box;
}

void check_tight(const Shape& shape, const Matrix& m, const Box& surface, double slack) {
    const Box box = solid_box(shape, m);
    CHECK(inside(box, surface));
    CHECK(same(box, surface, slack));
    CHECK(inside(brlcad_box(shape, m),
                 Box{at(identity, wide(surface.low) + Wide(1e-9)), at(identity, wide(surface.high) - Wide(1e-9))}));
}

std::vector<Plane> cube_planes(double size) {
    return {{{1, 0, 0}, size},  {{-1, 0, 0}, size}, {{0, 1, 0}, size},
            {{0, -1, 0}, size}, {{0, 0, 1}, size},  {{0, 0, -1}, size}};
}

}  // namespace

TEST_CASE("the boxes of ellipsoids, tori and cones are tight under any matrix") {
    Random random;
    for (int round = 0; round < test::tries(10); ++round) {
        const Matrix m = random.matrix();
        const Wide v = random.wide(), a = random.wide(), b = random.wide(), c = random.wide();
        const Ell ell{narrow(v), narrow(a), narrow(b), narrow(c)};
        check_tight(ell, m,
                    sampled(m,
                            [&](double u, double w) {
                                const long double e = pi * (w - 0.5);
                                return v + std::cos(u) * std::cos(e) * a + std::sin(u) * std::cos(e) * b +
                                       std::sin(e) * c;
                            }),
                    1e-3);

        const long double shrink = random(0, 1);
        const Tgc tgc{narrow(v), narrow(c), narrow(a), narrow(b), narrow(shrink * a), narrow(0.5L * b)};
        check_tight(tgc, m,
                    sampled(m,
                            [&](double u, double w) {
                                const long double ra = 1 + (shrink - 1) * w, rb = 1 - 0.5L * w;
                                return v + static_cast<long double>(w) * c +
                                       std::cos(static_cast<long double>(u)) * ra * a + std::sin(u) * rb * b;
                            }),
                    1e-3);

        const Wide h = glm::normalize(a), x = glm::normalize(glm::cross(h, b)), y = glm::cross(h, x);
        const Tor tor{narrow(v), narrow(2.5L * h), 3, 0.5};
        check_tight(tor, m,
                    sampled(m,
                            [&](double u, double w) {
                                const long double radius = 3 + 0.5L * std::cos(2 * pi * w);
                                return v +
                                       radius * (std::cos(static_cast<long double>(u)) * x +
                                                 std::sin(static_cast<long double>(u)) * y) +
                                       0.5L * std::sin(static_cast<long double>(2 * pi * w)) * h;
                            }),
                    1e-3);
    }
}

TEST_CASE("the box of a hyperboloid holds it") {
    Random random;
    for (int round = 0; round < test::tries(10); ++round) {
        const Matrix m = random.matrix();
        const Wide v = random.wide(), h = 3.0L * random.wide(), a = glm::normalize(glm::cross(h, random.wide()));
        const Wide b = glm::normalize(glm::cross(h, a));
        const Ehy ehy{narrow(v), narrow(h), narrow(a), 2, 1, 0.3};
        const long double c = 0.3L / glm::length(h);
        const Box surface = sampled(m, [&](double u, double w) {
            const long double zeta = c + w, r = std::sqrt((zeta * zeta - c * c) / (1 + 2 * c));
            return v + (1 - static_cast<long double>(w)) * h +
                   r * (2 * std::cos(static_cast<long double>(u)) * a + std::sin(static_cast<long double>(u)) * b);
        });
        const Box box = solid_box(ehy, m);
        CHECK(inside(box, surface));
        CHECK(diagonal(box) < 2 * diagonal(surface));
    }
}

TEST_CASE("the box of an arb is that of its corners, of an arbn that of its vertices") {
    Random random;
    for (int round = 0; round < test::tries(10); ++round) {
        const Matrix m = random.matrix();
        const Arb arb = block_shape({-1, -2, -3}, {4, 5, 6});
        Box corners = empty_box;
        for (const Vec3& p : arb.vertices) extend(corners, at(m, wide(p)));
        CHECK(inside(solid_box(arb, m), corners));
        CHECK(same(solid_box(arb, m), corners, 1e-12));
        CHECK(same(brlcad_box(arb, m), corners, 0));
        const Arbn arbn{
            {{{1, 0, 0}, 4}, {{-1, 0, 0}, 1}, {{0, 1, 0}, 5}, {{0, -1, 0}, 2}, {{0, 0, 1}, 6}, {{0, 0, -1}, 3}}};
        CHECK(inside(solid_box(arbn, m), corners));
        CHECK(same(solid_box(arbn, m), corners, 1e-6));
    }
    CHECK(same(brlcad_box(Arbn{cube_planes(1)}, identity), {{-1, -1, -1}, {1, 1, 1}}, 0));
    CHECK_FALSE(is_finite(solid_box(Half{{{0, 0, 1}, 3}}, identity)));
}

TEST_CASE("an arb with a twisted face reaches as far as its planes do, which may be beyond its corners") {
    Arb arb = block_shape({0, 0, 0}, {10, 10, 10});
    arb.vertices[4].z = 8;  // below the plane of the other three of its top: the planes meet above it
    Box corners = empty_box;
    for (const Vec3& p : arb.vertices) extend(corners, p);
    const ArbFaces faces = arb_faces(arb, identity);
    CHECK_FALSE(faces.is_hull);
    const Box box = solid_box(arb, identity);
    CHECK(inside(box, corners));
    Random random;
    int in_solid = 0;
    for (int i = 0; i < 200000; ++i) {
        const Vec3 p{random(-5, 20), random(-5, 20), random(-5, 20)};
        const bool in = std::all_of(faces.planes.begin(), faces.planes.end(), [&](const Plane& plane) {
            return plane.normal.x * p.x + plane.normal.y * p.y + plane.normal.z * p.z <= plane.distance;
        });
        if (!in) continue;
        ++in_solid;
        REQUIRE(inside(box, p));
    }
    CHECK(in_solid > 1000);
}

TEST_CASE("faces: arb8 to arb4, degenerate corners dropped, normals outward under mirrors", "[promise:solids]") {
    const Matrix mirror = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const Vec3 o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, xy{1, 1, 0};
    const Arb box = block_shape({0, 0, 0}, {1, 1, 1});
    const Arb arb5{{{o, x, xy, y, z, z, z, z}}};
    const Arb arb4{{{o, x, y, y, z, z, z, z}}};
    const Arb arb6{{{o, x, xy, y, z, z, {0, 1, 1}, {0, 1, 1}}}};
    for (const Matrix& m : {identity, mirror, askew(1, {5, 6, 7})}) {
        for (const auto& [arb, count] :
             {std::pair{box, 6u}, std::pair{arb6, 5u}, std::pair{arb5, 5u}, std::pair{arb4, 4u}}) {
            const ArbFaces faces = arb_faces(arb, m);
            REQUIRE(faces.planes.size() == count);
            CHECK(faces.is_hull);
            Wide mean(0);
            for (const Vec3& p : arb.vertices) mean += transform_point(m, wide(p)) / 8.0L;
            for (const Plane& plane : faces.planes) CHECK(glm::dot(wide(plane.normal), mean) < plane.distance - 0.05);
        }
    }
}

TEST_CASE("boxes of polyhedra: random ones against all triples of planes") {
    Random random;
    constexpr int rounds = test::tries(60);
    int closed = 0;
    for (int round = 0; round < rounds; ++round) {
        const Vec3 center{random(-100, 100), random(-100, 100), random(-100, 100)};
        std::vector<Plane> planes;
        for (int i = 0; i < (round % 2 == 0 ? 12 : 24); ++i) {  // few, or many
            const Wide n = glm::normalize(random.wide());
            planes.push_back(plane_through(wide(center) + static_cast<long double>(random(0.5, 2)) * n, n));
            if (i % 4 == 0) planes.push_back(planes.back());  // said twice
        }
        Box expected = empty_box;
        for (std::size_t i = 0; i < planes.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                for (std::size_t k = 0; k < j; ++k) {
                    const WideMatrix n = glm::transpose(
                        WideMatrix(wide(planes[i].normal), wide(planes[j].normal), wide(planes[k].normal)));
                    if (std::fabs(glm::determinant(n)) < 1e-9L) continue;
                    const Wide p = glm::inverse(n) * Wide(planes[i].distance, planes[j].distance, planes[k].distance);
                    if (std::all_of(planes.begin(), planes.end(), [&](const Plane& plane) {
                            return glm::dot(wide(plane.normal), p) <= plane.distance + 1e-10L;
                        }))
                        extend(expected, narrow(p));
                }
        const Box box = polyhedron_box(planes);
        if (!is_finite(box)) continue;  // twelve random planes may leave a side open
        ++closed;
        CHECK(same(box, expected, 1e-7 * diagonal(expected)));
    }
    CHECK(3 * closed > 2 * rounds);
}

TEST_CASE("polyhedra that are not bounded, or hold no point") {
    const double slope = 1e-4;
    std::vector<Plane> open = cube_planes(5), none = cube_planes(5);
    open.pop_back();
    none.push_back({{1, 0, 0}, -6});
    // A long wedge is bounded all the same.
    std::vector<Plane> wedge = {
        {{slope, 1, 0}, 1}, {{slope, -1, 0}, 1}, {{-1, 0, 0}, 0}, {{0, 0, 1}, 1}, {{0, 0, -1}, 1}};
    for (const std::size_t repeats : {1u, 5u}) {  // few planes, and many
        const auto repeated = [&](const std::vector<Plane>& planes) {
            std::vector<Plane> all;
            for (std::size_t i = 0; i < repeats; ++i) all.insert(all.end(), planes.begin(), planes.end());
            return all;
        };
        CHECK_FALSE(is_finite(polyhedron_box(repeated(open))));
        CHECK_FALSE(is_finite(polyhedron_box(repeated({open[0], open[1]}))));
        CHECK(is_empty(polyhedron_box(repeated(none))));
        CHECK(is_empty(polyhedron_box(repeated({none[1], none[6]}))));
        CHECK(near(polyhedron_box(repeated(wedge)).high.x, 1e4, 1e-3));
        CHECK(same(polyhedron_box(repeated(cube_planes(5))), {{-5, -5, -5}, {5, 5, 5}}, 0));
    }
    CHECK_FALSE(is_finite(polyhedron_box({})));
}

TEST_CASE("a polyhedron of 60,000 faces takes no time to speak of") {
    Random random;
    std::vector<Plane> planes;
    for (int i = 0; i < 60000; ++i) {
        const Wide point = random.wide();
        planes.push_back(plane_through(glm::normalize(random.wide()), point));
    }
    for (Plane& plane : planes) plane.distance = 1;
    const Box box = polyhedron_box(planes);
    CHECK(same(box, {{-1, -1, -1}, {1, 1, 1}}, 1e-3));
}

TEST_CASE("BRL-CAD's boxes of cones and hyperboloids are those of the bodies around them") {
    const double r = std::sqrt(0.5);
    const Matrix turn = turned(pi / 4);
    const Tgc cylinder{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}};
    const Tgc cone{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {r, 0, 0}, {0, r, 0}};
    CHECK(same(brlcad_box(cylinder, turn), {{-1, -1, 0}, {1, 1, 1}}, 1e-12));
    CHECK(same(brlcad_box(cone, turn), {{-2 * r, -2 * r, 0}, {2 * r, 2 * r, 1}}, 1e-12));
    CHECK(same(solid_box(cone, turn), {{-1, -1, 0}, {1, 1, 1}}, 1e-12));
}

TEST_CASE("a tree's box: union and xor both, intersection what is common, difference the left side") {
    const std::vector<Box> boxes = {
        {{0, 0, 0}, {2, 2, 2}}, {{1, 1, 1}, {5, 5, 5}}, whole_space, {{7, 7, 7}, {8, 8, 8}}};
    const auto box_of = [&](std::initializer_list<std::uint32_t> solids, Operator op) {
        FlatTree tree;
        for (const std::uint32_t s : solids) tree.nodes.push_back({Operator::leaf, 0, s});
        tree.nodes.push_back({op, static_cast<std::uint32_t>(solids.size()), 0});
        return tree_box(tree, boxes);
    };
    CHECK(same(box_of({0, 1}, Operator::union_), {{0, 0, 0}, {5, 5, 5}}, 0));
    CHECK(same(box_of({0, 1}, Operator::xor_), {{0, 0, 0}, {5, 5, 5}}, 0));
    CHECK(same(box_of({0, 1}, Operator::intersection), {{1, 1, 1}, {2, 2, 2}}, 0));
    CHECK(same(box_of({0, 1, 2}, Operator::difference), boxes[0], 0));
    CHECK(same(box_of({2, 1}, Operator::intersection), boxes[1], 0));
    CHECK_FALSE(is_finite(box_of({2, 1}, Operator::difference)));
    CHECK_FALSE(is_finite(box_of({0}, Operator::not_)));
    CHECK(is_empty(box_of({0, 3}, Operator::intersection)));
}
