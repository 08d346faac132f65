// Which arbs are surfaces: those with flat faces that are not convex. What crosses itself is refused; all else is as it
// was.
#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "compile/compiled_scene.hpp"
#include "compile/model.hpp"
#include "kernel_host/geometry.hpp"
#include "scene/solids/arb_form.hpp"
#include "scene/faults/solids.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

const Arb dart{{{{0, 0, 0}, {10, 0, 0}, {3, 3, 0}, {0, 10, 0}, {0, 0, 5}, {10, 0, 5}, {3, 3, 5}, {0, 10, 5}}}};

std::uint32_t type_of(const Arb& arb) {
    return compile(scene({solid("a", arb), region("r", {leg("a")})})).solids[0].type;
}

Arb scaled(Arb arb, double by) {
    for (Vec3& v : arb.vertices) v = {by * v.x, by * v.y, by * v.z};
    return arb;
}

}  // namespace

TEST_CASE("arbs with flat faces that are not convex are surfaces of triangles") {
    CHECK(type_of(dart) == SOLID_MESH);
    CHECK(type_of(scaled(dart, 1e-6)) == SOLID_MESH);
    CHECK(type_of(scaled(dart, 1e6)) == SOLID_MESH);
    Arb shallow = dart, convex = dart, straight = dart;
    for (const std::size_t i : {2, 6}) {
        shallow.vertices[i].x = shallow.vertices[i].y = 5 - 1e-8;
        straight.vertices[i].x = straight.vertices[i].y = 5;
        convex.vertices[i].x = convex.vertices[i].y = 5 + 1e-8;
    }
    CHECK(type_of(shallow) == SOLID_MESH);
    CHECK(type_of(straight) == SOLID_ARB);
    CHECK(type_of(convex) == SOLID_ARB);
    const auto& v = dart.vertices;
    CHECK(type_of({{v[0], v[1], v[2], v[3], v[4], v[4], v[4], v[4]}}) == SOLID_MESH);  // a pyramid over a dart: arb5
    CHECK(type_of(block_shape({0, 0, 0}, {1, 2, 3})) == SOLID_ARB);
}

TEST_CASE("arbs with a face that is not flat stay half-spaces") {
    Arb twisted = dart;
    twisted.vertices[6].z += 0.01;
    CHECK(type_of(twisted) == SOLID_ARB);
    // BRL-CAD's tolerance, 0.0005 mm, and a part of the size.
    Arb nearly = scaled(dart, 1000);
    nearly.vertices[6].z += 4e-4;
    CHECK(type_of(nearly) == SOLID_MESH);
    nearly.vertices[6].z += 1e-3;
    CHECK(type_of(nearly) == SOLID_ARB);
    twisted = dart;
    twisted.vertices[6].z += 1e-6;
    CHECK(type_of(twisted) == SOLID_MESH);
}

TEST_CASE("arbs with a flat face that crosses itself are refused by name", "[promise:refusals]") {
    Arb crossed = block_shape({0, 0, 0}, {4, 2, 3});
    CHECK(solid_faults(crossed).empty());
    std::swap(crossed.vertices[2], crossed.vertices[3]);
    std::swap(crossed.vertices[6], crossed.vertices[7]);
    CHECK(crossing_face(crossed) == 0);
    CHECK(test::says(test::error_of([&] {
                         compile(scene({solid("bow", crossed), region("r", {leg("bow")})}));
                     }),
                     "solid 'bow': its face 3 2 1 0 crosses itself"));
    CHECK(solid_faults(dart).empty());
}
