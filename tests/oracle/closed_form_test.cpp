// The oracle against facts that need no ray tracer: chords with whole-number lengths, volumes, areas of sections.
#include "catch.hpp"

#include "oracle/intersect.hpp"
#include "oracle/print.hpp"
#include "oracle/shapes.hpp"

using namespace csgrt;
using namespace csgrt::oracle;

namespace {

constexpr double pi = 3.14159265358979323846;

Answer shoot(const Shape& shape, const Ray& ray, const Matrix& matrix = identity) {
    return intersect(implicit(shape, matrix), ray);
}

/// Decided, and exactly these ends.
void check_ends(const Answer& answer, const std::vector<std::array<double, 2>>& expected) {
    CHECK_FALSE(answer.tie);
    REQUIRE(answer.intervals.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto close = [](double a, double b) { return a == b || std::abs(a - b) <= 1e-15 * std::abs(b); };
        CHECK(close(answer.intervals[i].in.t, expected[i][0]));
        CHECK(close(answer.intervals[i].out.t, expected[i][1]));
    }
}

void check_normal(const Vec3& n, const Vec3& expected) {
    CHECK(std::abs(n.x - expected.x) + std::abs(n.y - expected.y) + std::abs(n.z - expected.z) < 1e-15);
}

void check_close(double value, double expected, double relative) {
    INFO(value << " and " << expected);
    CHECK(std::abs(value - expected) <= relative * std::abs(expected));
}

/// Volume by chords along z over an n x n grid of pixel centres; the solid lies within +-reach in x and y.
double volume(const Shape& shape, const Matrix& matrix, double reach, int n) {
    const ImplicitSolid solid = implicit(shape, matrix);
    const double step = 2 * reach / n;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Ray ray{{-reach + (i + 0.5) * step, -reach + (j + 0.5) * step, -50}, {0, 0, 2}};
            for (const Interval& k : intersect(solid, ray).intervals) sum += 2 * (k.out.t - k.in.t);
        }
    return sum * step * step;
}

const Matrix stretched = {1, 0.5, 0, 0.25, 0, 2, 0, -0.5, 0, 0.25, 0.5, 0.125, 0, 0, 0, 1};  // determinant 1

}  // namespace

TEST_CASE("oracle: sphere through the centre, off the centre, from far away, from inside", "[oracle]") {
    const Shape sphere = Ell{{1, 2, 3}, {5, 0, 0}, {0, 5, 0}, {0, 0, 5}};
    const Answer through = shoot(sphere, {{-10, 2, 3}, {1, 0, 0}});
    check_ends(through, {{6, 16}});
    check_normal(through.intervals[0].in.normal, {-1, 0, 0});
    check_normal(through.intervals[0].out.normal, {1, 0, 0});
    const Answer chord = shoot(sphere, {{-9, 5, 3}, {2, 0, 0}});  // 3 off: half the chord is 4
    check_ends(chord, {{3, 7}});
    check_normal(chord.intervals[0].in.normal, {-0.8, 0.6, 0});
    check_ends(shoot(sphere, {{1e6 + 1, 6, 3}, {-1, 0, 0}}), {{1e6 - 3, 1e6 + 3}});
    check_ends(shoot(sphere, {{1, 2, 3}, {0, 0, 1e-3}}), {{-5000, 5000}});
    CHECK(shoot(sphere, {{-10, 7.5, 3}, {1, 0, 0}}).intervals.empty());
}

TEST_CASE("oracle: ellipsoid", "[oracle]") {
    const Shape ell = Ell{{0, 0, 0}, {4, 0, 0}, {0, 2, 0}, {0, 0, 1}};
    const Answer a = shoot(ell, {{2.4, -9, 0}, {0, 1, 0}});  // x = 0.6 x 4, so y = +-0.8 x 2
    check_ends(a, {{7.4, 10.6}});
    const double n = std::hypot(2.4 / 16, 1.6 / 4);
    check_normal(a.intervals[0].out.normal, {2.4 / 16 / n, 1.6 / 4 / n, 0});
}

TEST_CASE("oracle: cylinders and cones", "[oracle]") {
    const Shape cylinder = Tgc{{0, 0, 0}, {0, 0, 10}, {5, 0, 0}, {0, 5, 0}, {5, 0, 0}, {0, 5, 0}};
    const Answer axis = shoot(cylinder, {{1, 1, -2}, {0, 0, 1}});
    check_ends(axis, {{2, 12}});
    check_normal(axis.intervals[0].in.normal, {0, 0, -1});
    check_normal(axis.intervals[0].out.normal, {0, 0, 1});
    check_ends(shoot(cylinder, {{-10, 3, 4}, {1, 0, 0}}), {{6, 14}});
    CHECK(shoot(cylinder, {{-10, 3, 11}, {1, 0, 0}}).intervals.empty());
    CHECK(shoot(cylinder, {{6, 0, -2}, {0, 0, 1}}).intervals.empty());

    const Shape cone = Tgc{{0, 0, 0}, {0, 0, 10}, {5, 0, 0}, {0, 5, 0}, {0, 0, 0}, {0, 0, 0}};
    check_ends(shoot(cone, {{-10, 0, 4}, {1, 0, 0}}), {{7, 13}});  // radius 3 at 4
    const Answer flank = shoot(cone, {{-10, 0, 4}, {1, 0, 0}});
    const double slope = std::hypot(2.0, 1.0);
    check_normal(flank.intervals[0].in.normal, {-2 / slope, 0, 1 / slope});
    check_ends(shoot(cone, {{3, 0, -5}, {0, 0, 1}}), {{5, 9}});

    const Shape oblique = Tgc{{0, 0, 0}, {10, 0, 10}, {1, 0, 0}, {0, 2, 0}, {1, 0, 0}, {0, 2, 0}};
    check_ends(shoot(oblique, {{-10, 0, 3}, {1, 0, 0}}), {{12, 14}});
    check_ends(shoot(oblique, {{3, -10, 3}, {0, 1, 0}}), {{8, 12}});

    // A from 2 to 1 and B from 1 to 3: at half the height 1.5 and 2.
    const Shape general = Tgc{{0, 0, 0}, {0, 0, 4}, {2, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 3, 0}};
    check_ends(shoot(general, {{-10, 0, 2}, {1, 0, 0}}), {{8.5, 11.5}});
    check_ends(shoot(general, {{0, -10, 2}, {0, 1, 0}}), {{8, 12}});
    check_ends(shoot(general, {{0, 0, -1}, {0, 0, 1}}), {{1, 5}});
    check_ends(shoot(general, {{0.9, -10, 2}, {0, 1, 0}}), {{8.4, 11.6}});  // 0.6 of A leaves 0.8 of B
    check_ends(shoot(general, {{1.75, 0, -1}, {0, 0, 1}}), {{1, 2}});       // A is 1.75 at z = 1
}

TEST_CASE("oracle: torus", "[oracle]") {
    const Shape torus = Tor{{0, 0, 0}, {0, 0, 7}, 4, 1};
    const Answer across = shoot(torus, {{-10, 0, 0}, {1, 0, 0}});
    check_ends(across, {{5, 7}, {13, 15}});
    check_normal(across.intervals[0].out.normal, {1, 0, 0});
    check_normal(across.intervals[1].in.normal, {-1, 0, 0});
    check_ends(shoot(torus, {{4, 0, -3}, {0, 0, 1}}), {{2, 4}});
    check_ends(shoot(torus, {{4.6, 0, -3}, {0, 0, 1}}), {{2.2, 3.8}});
    check_ends(shoot(torus, {{0, 0, -3}, {0, 0, 1}}), {});
    check_ends(shoot(torus, {{-10, 0, 0.6}, {1, 0, 0}}), {{5.2, 6.8}, {13.2, 14.8}});
    check_ends(shoot(torus, {{-10, 4.8, 0}, {1, 0, 0}}), {{8.6, 11.4}});  // 5^2 - 4.8^2 = 1.4^2
    check_ends(shoot(torus, {{-10, 1.4, 0}, {1, 0, 0}}),
               {{10 - 4.8, 10 - std::sqrt(7.04)}, {10 + std::sqrt(7.04), 14.8}});
    CHECK(shoot(torus, {{-10, 3, 0}, {1, 0, 0}}).tie);  // touches the inner equator
}

TEST_CASE("oracle: polyhedra and half-spaces", "[oracle]") {
    const Shape box = Arb{{{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {0, 0, 4}, {2, 0, 4}, {2, 3, 4}, {0, 3, 4}}}};
    const Answer a = shoot(box, {{-1, 1, 1}, {1, 0, 0}});
    check_ends(a, {{1, 3}});
    check_normal(a.intervals[0].in.normal, {-1, 0, 0});
    check_ends(shoot(box, {{-1, -1, 1}, {1, 1, 0}}), {{1, 3}});
    const Shape pyramid =
        Arb{{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}}}};
    CHECK(implicit(pyramid, identity).surfaces.size() == 5 + 6);  // its faces and its box
    check_ends(shoot(pyramid, {{-5, 0.1, 0.5}, {1, 0, 0}}), {{4.5, 5.5}});
    const Shape tetrahedron =
        Arb{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}}}};
    CHECK(implicit(tetrahedron, identity).surfaces.size() == 4 + 6);
    check_ends(shoot(tetrahedron, {{0.25, 0.25, -1}, {0, 0, 1}}), {{1, 1.5}});
    const Shape arbn = Arbn{{{{1, 0, 0}, 1},
                             {{-1, 0, 0}, 1},
                             {{0, 1, 0}, 1},
                             {{0, -1, 0}, 1},
                             {{0, 0, 1}, 1},
                             {{0, 0, -1}, 1},
                             {{0.6, 0, 0.8}, 1}}};
    check_ends(shoot(arbn, {{0.75, 0, -5}, {0, 0, 1}}), {{4, 5.6875}});  // 0.45 + 0.8 z = 1
    const Shape half = Half{{{0, 0, 1}, 3}};
    check_ends(shoot(half, {{0, 0, 5}, {0, 0, -1}}), {{2, std::numeric_limits<double>::infinity()}});
    check_ends(shoot(half, {{0, 0, 5}, {3, 0, 2}}), {{-std::numeric_limits<double>::infinity(), -1}});
    check_ends(shoot(half, {{0, 0, 5}, {1, 0, 0}}), {});
    const double inf = std::numeric_limits<double>::infinity();
    check_ends(shoot(half, {{0, 0, 2}, {1, 0, 0}}), {{-inf, inf}});
}

TEST_CASE("oracle: hyperboloid, its sections", "[oracle]") {
    // |h| = 3, c = 1: at a distance s below the apex the radius is r sqrt(((1 + s)^2 - 1) / 15), at s = 1: sqrt(3 /
    // 15).
    const Shape ehy = Ehy{{0, 0, 0}, {0, 0, 3}, {1, 0, 0}, 4, 2, 1};
    const double at_1 = std::sqrt(3.0 / 15);
    check_ends(shoot(ehy, {{-10, 0, 2}, {1, 0, 0}}), {{10 - 4 * at_1, 10 + 4 * at_1}});
    check_ends(shoot(ehy, {{0, -10, 2}, {0, 1, 0}}), {{10 - 2 * at_1, 10 + 2 * at_1}});
    const Answer axis = shoot(ehy, {{0, 0, -1}, {0, 0, 1}});
    check_ends(axis, {{1, 4}});
    check_normal(axis.intervals[0].in.normal, {0, 0, -1});
    check_normal(axis.intervals[0].out.normal, {0, 0, 1});
    CHECK(shoot(ehy, {{-10, 0, 3.5}, {1, 0, 0}}).intervals.empty());  // between the two sheets
    CHECK(shoot(ehy, {{-10, 0, 6}, {1, 0, 0}}).intervals.empty());    // the other sheet is not part of it
    CHECK(shoot(ehy, {{-10, 0, -0.5}, {1, 0, 0}}).intervals.empty());
    // Areas of sections by chords: pi r_1 r_2 (zeta^2 - c^2) / (h^2 + 2 h c).
    const ImplicitSolid solid = implicit(ehy, identity);
    for (const double z : {0.5, 1.0, 2.0, 2.75}) {
        double area = 0;
        const int n = 2000;
        for (int i = 0; i < n; ++i) {
            const double y = -2 + (i + 0.5) * 4.0 / n;
            for (const Interval& k : intersect(solid, {{-10, y, z}, {1, 0, 0}}).intervals)
                area += (k.out.t - k.in.t) * 4.0 / n;
        }
        const double zeta = 4 - z;
        check_close(area, pi * 8 * (zeta * zeta - 1) / 15, 1e-4);
    }
}

TEST_CASE("oracle: volumes by chords, as they are and under a matrix of determinant 1", "[oracle]") {
    struct Known {
        const char* name;
        Shape shape;
        double volume;
    };
    const double a = 1.5, b = 0.5, c = 0.75, d = 2, h = 2.5;
    const Known solids[] = {
        {"ell", Ell{{0.1, 0.2, 0.3}, {2, 0, 0}, {0.5, 1, 0}, {0, 0.25, 1.5}}, 4 * pi / 3 * 3},
        {"tgc", Tgc{{0, 0, -1}, {0.5, -0.5, h}, {a, 0, 0}, {0, b, 0}, {c, 0, 0}, {0, d, 0}},
         pi * h * (a * b / 3 + c * d / 3 + (a * d + b * c) / 6)},
        {"cone", Tgc{{0, 0, -1}, {0.25, 0, 2}, {1, 0, 0}, {0, 2, 0}, {0, 0, 0}, {0, 0, 0}}, pi * 2 * 2 / 3},
        {"inverted cone", Tgc{{0, 0, -1}, {0.25, 0, 2}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, pi * 2 * 2 / 3},
        {"arb5", Arb{{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}}}},
         4.0 / 3},
        {"tor", Tor{{0, 0, 0}, {1, 0, 0}, 2, 0.5}, 2 * pi * pi * 2 * 0.25},
        {"thick tor", Tor{{0, 0, 0}, {0, 1, 1}, 1, 1}, 2 * pi * pi},
        {"ehy", Ehy{{0, 0, -1}, {0, 0, 3}, {1, 0, 0}, 1.5, 2, 1}, pi * 3 * ((64 - 1) / 3.0 - 3) / 15},
    };
    for (const Known& known : solids) {
        INFO(known.name);
        check_close(volume(known.shape, identity, 2.6, 56), known.volume, 2e-2);
        check_close(volume(known.shape, stretched, 5.75, 84), known.volume, 2e-2);
    }
}

TEST_CASE("oracle: a solid and a ray moved by the same map keep their distances", "[oracle]") {
    Random random(4);
    const QAffine map = to_affine(stretched);
    for (int kind = 0; kind < 7; ++kind)
        for (std::size_t i = 0; i < 40; ++i) {
            const Case one = make_case(static_cast<Kind>(kind), i, random);
            const ImplicitSolid solid = implicit(one.shape, identity), moved = implicit(one.shape, stretched);
            const QVec o = solid.center + quad(3 * solid.size + 1) * random.direction();
            const Ray ray{to_vec3(o), to_vec3(unit(solid.center + quad(0.5 * solid.radius) * random.in_cube() - o))};
            const Ray carried{to_vec3(map.point(ray.origin)), to_vec3(map.direction(ray.direction))};
            const Answer a = intersect(solid, ray), b = intersect(moved, carried);
            if (a.tie || b.tie) continue;
            INFO(one.name << "\n" << describe(one.shape, stretched) << "\n" << describe(ray));
            REQUIRE(a.intervals.size() == b.intervals.size());
            for (std::size_t k = 0; k < a.intervals.size(); ++k) {
                if (std::isinf(a.intervals[k].in.t)) continue;
                CHECK(std::abs(a.intervals[k].in.t - b.intervals[k].in.t) <=
                      a.intervals[k].in.tolerance + b.intervals[k].in.tolerance);
            }
        }
}
