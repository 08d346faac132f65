#include "catch.hpp"
#include "kernels/geometry/kernel_answer.hpp"
#include "oracle/solids/all.hpp"

using namespace csgrt;

// The two vectors of an axis are parallel to 1e-7 in BRL-CAD's models: csgrt, the oracle and BRL-CAD take the base's
// direction.
TEST_CASE("geometry: a tgc whose longer semi-axis leans a little lies along that of its base", "[geometry]") {
    const double lean = 1e-7;
    const Tgc tgc{{0, 0, 0}, {0, 0, 4}, {2, 0, 0}, {0, 1, 0}, {2.5, 2.5 * lean, 0}, {0, 0.5, 0}};
    const oracle::ImplicitSolid solid = oracle::implicit(tgc, oracle::to_affine(identity));
    for (const double y : {0.3, -0.4, 0.6}) {
        const Ray ray{{-5, y, 1}, {1, 0.03, 0.02}};
        const auto segments = kernel_answer(tgc, identity)(ray);
        REQUIRE(segments.size() == 1);
        const auto inside = [&](double t) {
            return solid.contains(oracle::QVec(ray.origin) + oracle::quad(t) * oracle::QVec(ray.direction));
        };
        CHECK(!inside(segments[0].in - 1e-12));
        CHECK(inside(segments[0].in + 1e-12));
        CHECK(inside(segments[0].out - 1e-12));
        CHECK(!inside(segments[0].out + 1e-12));
    }
}
