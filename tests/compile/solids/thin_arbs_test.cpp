// Arbs as thin as rounding lets them be, with corners rounded where they stand: they are what their numbers say.
#include <random>

#include "catch.hpp"
#include "compile/model.hpp"
#include "compile/solids/polyhedron.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

/// Turned and moved, each corner rounded to double.
Arb stood(Arb arb, const Matrix& m) {
    for (Vec3& v : arb.vertices) v = narrow(transform_point(m, wide(v)));
    return arb;
}

/// All six sides, and three of them through every corner but for rounding.
void check_sides(const Arb& arb, double size) {
    const ArbFaces faces = arb_faces(arb, identity);
    REQUIRE(faces.is_hull);
    REQUIRE(faces.planes.size() == 6);
    for (const Vec3& v : arb.vertices) {
        std::size_t through = 0;
        for (const Plane& plane : faces.planes)
            through += std::abs(glm::dot(wide(plane.normal), wide(v)) - plane.distance) < 1e-14 * size;
        CHECK(through >= 3);
    }
}

}  // namespace

TEST_CASE("plates, needles and blocks with one thin edge, of any lean, keep their six sides", "[promise:rounding]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> angle(0, 6), side(3, 20), place(-10, 10);
    for (double thin = 1e-2; thin > 2e-10; thin /= 3)
        for (int i = 0; i < 40; ++i) {
            const double x = side(random), y = side(random), z = thin * x, size = x + y;
            const Vec3 at{place(random), place(random), place(random)};
            const Matrix m = askew(angle(random), at);
            INFO(thin << " " << i);
            check_sides(stood(block_shape({0, 0, 0}, {x, y, z}), m), size + 10);  // a plate
            check_sides(stood(block_shape({0, 0, 0}, {z, 2 * z, y}), m), size + 10);
            Arb wedge = block_shape({0, 0, 0}, {x, y, z});  // thick at one end: its sides are slivers at the other
            for (const std::size_t v : {i % 2 == 0 ? 5u : 4u, i % 2 == 0 ? 6u : 7u}) wedge.vertices[v].z = 0.5 * x;
            check_sides(stood(wedge, m), size + 10);
        }
}

TEST_CASE("a thin arb whose corners leave a plane by more than rounding is seen as twisted") {
    for (const double thin : {1e-3, 1e-5}) {
        Arb twisted = stood(block_shape({0, 0, 0}, {12, 12, 12 * thin}), askew(1.1));
        CHECK(arb_faces(twisted, identity).is_hull);
        twisted.vertices[6].z += 1e-9;
        CHECK_FALSE(arb_faces(twisted, identity).is_hull);
    }
}
