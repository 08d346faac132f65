// Which solids of a closed form enclose something, and what is said of those that do not.
#include "catch.hpp"

#include <limits>

#include "scene/solid_faults.hpp"

using namespace csgrt;

namespace {

void check_sound(const Shape& shape) {
    const auto faults = solid_faults(shape);
    INFO((faults.empty() ? std::string() : faults[0]));
    CHECK(faults.empty());
}
void check_fault(const Shape& shape, const std::string& part_of_message) {
    const auto faults = solid_faults(shape);
    INFO(part_of_message);
    REQUIRE(faults.size() == 1);
    INFO(faults[0]);
    CHECK(faults[0].find(part_of_message) != std::string::npos);
}

const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, none{};
constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("solid faults: particles") {
    check_sound(Part{none, z, 1, 0.5});
    check_sound(Part{none, z, 0, 0.5});
    check_sound(Part{none, z, 9, 1});     // one ball
    check_sound(Part{none, none, 1, 1});  // BRL-CAD's sphere
    check_fault(Part{none, z, -1, 1}, "less than 0");
    check_fault(Part{none, z, 0, 0}, "greater than 0");
    check_fault(Part{none, z, infinite, 1}, "not finite");
}

TEST_CASE("solid faults: paraboloids, cylinders, hyperboloids") {
    check_sound(Epa{none, z, x, 2, 1});
    check_sound(Epa{none, z, {3, 0, 0}, 1, 2});
    check_fault(Epa{none, none, x, 1, 1}, "the height has length 0");
    check_fault(Epa{none, z, none, 1, 1}, "the direction a has length 0");
    check_fault(Epa{none, z, {1, 0, 1}, 1, 1}, "perpendicular");
    check_fault(Epa{none, z, x, 1, 0}, "r2");
    check_sound(Rpc{none, x, z, 1});
    check_fault(Rpc{none, x, {1, 0, 1}, 1}, "perpendicular");
    check_fault(Rpc{none, x, z, -1}, "half-width");
    check_sound(Rhc{none, x, z, 1, 0.1});
    check_fault(Rhc{none, x, none, 1, 1}, "breadth b has length 0");
    check_fault(Rhc{none, x, z, 1, 0}, "asymptotes");
    check_sound(Hyp{none, z, x, 1, 0.5});
    check_fault(Hyp{none, z, x, 0, 0.5}, "semi-axis b");
    check_fault(Hyp{none, z, x, 1, 1}, "between 0 and 1");
    check_fault(Hyp{none, z, {1, 0, 1}, 1, 0.5}, "perpendicular");
}

TEST_CASE("solid faults: elliptical tori") {
    check_sound(Eto{none, z, {0.5, 0, 1}, 1, 0.2});
    check_sound(Eto{none, z, x, 1, 1});  // touches its axis
    check_fault(Eto{none, none, x, 1, 1}, "the axis has length 0");
    check_fault(Eto{none, z, none, 1, 1}, "the semi-axis c has length 0");
    check_fault(Eto{none, z, x, 1, 0}, "r_d");
    check_fault(Eto{none, z, {1.1, 0, 0}, 1, 0.5}, "across the axis");
    check_fault(Eto{none, z, y, 0, 0.5}, "the radius");
}

TEST_CASE("solid faults: superellipsoids and hearts") {
    check_sound(Superell{none, x, y, z, 0.01, 100});
    check_fault(Superell{none, x, none, z, 1, 1}, "axis b has length 0");
    check_fault(Superell{none, x, y, {1, 1, 0}, 1, 1}, "one plane");
    check_fault(Superell{none, x, y, z, 0, 1}, "exponent n");
    check_fault(Superell{none, x, y, z, 1, infinite}, "not finite");
    check_sound(Hrt{none, x, y, z, 1});
    check_fault(Hrt{none, x, y, none, 1}, "axis z has length 0");
}
