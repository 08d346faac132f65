// Which solids enclose something, and what is said of those that do not.
#include "catch.hpp"

#include <cmath>

#include "formats/json/simple_solids.hpp"
#include "scene/faults/check_faults.hpp"

using namespace csgrt;

namespace {

const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, none{};

}  // namespace

TEST_CASE("solid faults: ellipsoids") {
    check_sound(sphere({1, 2, 3}, 1e-30));
    check_sound(sphere({1e12, 0, 0}, 1e12));
    check_sound(Ell{none, {1, 1, 0}, {0, 1, 0}, {0, 0, 1e-6}});
    check_fault(Ell{none, x, y, {1, 1, 1e-12}}, "lie in one plane");
    check_fault(Ell{none, x, none, z}, "the axis b has length 0");
    check_fault(Ell{none, none, none, none}, "the axis a", 3);
    check_fault(Ell{none, x, y, {0, 0, infinite}}, "not finite");
    check_fault(Ell{{not_a_number, 0, 0}, none, y, z}, "not finite");
}

TEST_CASE("solid faults: every form of cone that is allowed", "[promise:refusals]") {
    check_sound(cone(none, z, 1, 1));
    check_sound(cone(none, z, 1, 0));
    check_sound(cone(none, z, 0, 1));                       // the apex is the base
    check_sound(Tgc{none, {1, 1, 1}, x, y, x, y});          // oblique
    check_sound(Tgc{none, z, x, {0, 3, 0}, {2, 0, 0}, y});  // two tapers
    check_sound(Tgc{none, z, x, y, none, y});               // an edge at the top
    check_sound(Tgc{none, z, x, y, x, none});
    check_sound(Tgc{none, z, x, y, {1, 1e-6, 0}, {1e-6, 1, 0}});  // parallel in single precision
}

TEST_CASE("solid faults: cones that enclose nothing, or twist", "[promise:refusals]") {
    check_fault(Tgc{none, none, x, y, x, y}, "height has length 0");
    check_fault(Tgc{none, z, none, none, none, none}, "both points");
    check_fault(Tgc{none, z, x, none, x, y}, "axis b of the base");
    check_fault(Tgc{none, z, none, y, x, y}, "axis a of the base");
    check_fault(Tgc{none, z, none, none, x, none}, "top an edge");
    check_fault(Tgc{none, {1, 1, 0}, x, y, x, y}, "a and b and the height");
    check_fault(Tgc{none, x, none, none, x, y}, "c and d and the height");
    check_fault(Tgc{none, z, x, y, {1, 0.1, 0}, y}, "a and c must be parallel");
    check_fault(Tgc{none, z, x, y, x, {0.1, 1, 0}}, "b and d must be parallel");
    check_fault(Tgc{none, z, x, y, {-1, 0, 0}, y}, "a and c must not point in opposite");
    check_fault(Tgc{none, {0, 0, not_a_number}, x, y, x, y}, "not finite");
}

TEST_CASE("solid faults: arbs", "[promise:refusals]") {
    check_sound(box({0, 0, 0}, {1, 1, 1}));
    check_sound(box({0, 0, 0}, {1000, 1000, 1e-6}));
    check_sound(box({1e9, 1e9, 1e9}, {1e9 + 1, 1e9 + 1, 1e9 + 1}));
    check_sound(arb({none, x, y, z}));
    check_fault(box({0, 0, 0}, {1, 1, 0}), "no volume");
    check_fault(arb({none, x, y, {1, 1, 0}}), "no volume");
    check_fault(arb({none, x, {2, 0, 0}, {3, 0, 0}}), "no volume");  // in a line
    check_fault(Arb{}, "no volume");                                 // in a point
    check_fault(box({0, 0, 0}, {1, 1, infinite}), "not finite");
}

TEST_CASE("solid faults: half-spaces and what they bound", "[promise:refusals]") {
    const std::vector<Plane> corner = {{{-1, 0, 0}, 0}, {{0, -1, 0}, 0}, {{0, 0, -1}, 0}};
    std::vector<Plane> closed = corner;
    const double s = 1 / std::sqrt(3.0);
    closed.push_back({{s, s, s}, 1});
    check_sound(Half{{z, -5}});
    check_sound(Arbn{closed});
    check_fault(Half{{none, 1}}, "length 0");
    check_fault(Half{{{0, 0, 2}, 1}}, "not of length 1");
    check_fault(Half{{z, infinite}}, "not finite");
    check_fault(Arbn{corner}, "do not bound");
    check_fault(Arbn{}, "do not bound");
    closed.push_back({z, -1});
    check_fault(Arbn{closed}, "no volume in common");
    closed[1].normal = none;
    check_fault(Arbn{closed}, "of plane 1 has length 0");
    check_fault(Arbn{std::vector<Plane>(Limits::faces + 1, {z, 1})}, "at most 16384");
}

TEST_CASE("solid faults: tori", "[promise:refusals]") {
    check_sound(Tor{none, {0, 0, 7}, 2, 1});
    check_sound(Tor{none, z, 1, 1});  // a horn torus
    check_fault(Tor{none, z, 1, 1.5}, "must not be greater");
    check_fault(Tor{none, z, 1, 0}, "radius of the tube");
    check_fault(Tor{none, z, -1, 1}, "the radius must");
    check_fault(Tor{none, none, 2, 1}, "axis has length 0");
    check_fault(Tor{none, z, not_a_number, 1}, "not finite");
}

TEST_CASE("solid faults: hyperboloids") {
    check_sound(Ehy{none, {0, 0, 3}, x, 1, 2, 0.1});
    check_fault(Ehy{none, {0, 0, 3}, x, 0, 2, 1}, "r1");
    check_fault(Ehy{none, {0, 0, 3}, x, 1, -2, 1}, "r2");
    check_fault(Ehy{none, {0, 0, 3}, x, 1, 2, 0}, "asymptotes");
    check_fault(Ehy{none, none, x, 1, 2, 1}, "height");
    check_fault(Ehy{none, z, none, 1, 2, 1}, "direction a has length 0");
    check_fault(Ehy{none, z, {2, 0, 0}, 1, 2, 1}, "not of length 1");
    check_fault(Ehy{none, z, {0.8, 0, 0.6}, 1, 2, 1}, "perpendicular");
}

TEST_CASE("solid faults: what is not supported is not judged") { check_sound(Unsupported{"pipe"}); }
