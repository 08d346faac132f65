// Sketches as rational Bezier pieces, and what is said of those that cannot be.
#include "catch.hpp"

#include <cmath>

#include "scene/solids/sketch_curves.hpp"
#include "scene/faults/solids.hpp"

using namespace csgrt;

namespace {

const std::vector<Sketch::Point> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};

Extrude of(Sketch sketch) { return {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, std::move(sketch)}; }
Sketch with(std::vector<Sketch::Curve> curves) { return {"", square, std::move(curves), {}}; }
const std::vector<Sketch::Curve> closed{Sketch::Line{0, 1}, Sketch::Line{1, 2}, Sketch::Line{2, 3}, Sketch::Line{3, 0}};

void check_fault(const Shape& shape, const std::string& part_of_message) {
    const auto faults = solid_faults(shape);
    INFO(part_of_message);
    REQUIRE(faults.size() == 1);
    INFO(faults[0]);
    CHECK(faults[0].find(part_of_message) != std::string::npos);
}

CurvePoint middle_of(const BezierCurve& piece) {
    BezierCurve p = piece;
    for (CurvePoint& q : p) q.u *= q.weight, q.v *= q.weight;
    for (std::size_t round = 1; round < p.size(); ++round)
        for (std::size_t i = 0; i + round < p.size(); ++i)
            p[i] = {(p[i].u + p[i + 1].u) / 2, (p[i].v + p[i + 1].v) / 2, (p[i].weight + p[i + 1].weight) / 2};
    return {p[0].u / p[0].weight, p[0].v / p[0].weight, 1};
}

}  // namespace

TEST_CASE("sketches: arcs lie on their circles, on the right side, in pieces of at most a quarter",
          "[promise:scenes]") {
    for (const bool left : {false, true})
        for (const bool clockwise : {false, true})
            for (const double radius : {1.0, 1.25, 7.0, 1e7}) {
                CAPTURE(left, clockwise, radius);
                // From (0, 0) to (2, 0): the center lies at (1, +-off).
                const long double off = std::sqrt(static_cast<long double>(radius) * radius - 1) * (left ? 1 : -1);
                const auto pieces = bezier_curves(with({Sketch::Arc{0, 1, radius, left, clockwise}}));
                CHECK(pieces.front().front().u == 0);
                CHECK(pieces.back().back().u == 2);
                for (const BezierCurve& piece : pieces) {
                    REQUIRE(piece.size() == 3);
                    CHECK(piece[1].weight > 0.7L);
                    for (const CurvePoint& p : {piece[0], middle_of(piece), piece[2]}) {
                        const long double from_circle = std::hypot(p.u - 1, p.v - off) - radius;
                        CHECK(std::fabs(static_cast<double>(from_circle)) <= 1e-18 * radius + 1e-18);
                        // Counterclockwise from left to right runs below the chord.
                        CHECK((clockwise ? p.v : -p.v) >= -1e-12L);
                    }
                }
            }
}

TEST_CASE("sketches: a radius below 0 is a full circle") {
    const auto pieces = bezier_curves(with({Sketch::Arc{0, 2, -1, false, false}}));
    REQUIRE(pieces.size() == 4);
    CHECK(loose_ends(pieces).empty());
    for (const BezierCurve& piece : pieces) {
        const CurvePoint p = middle_of(piece);
        CHECK(static_cast<double>(std::hypot(p.u - 2, p.v - 2)) == Approx(std::sqrt(8.0)).epsilon(1e-17));
    }
}

TEST_CASE("sketches: a clamped B-spline without inner knots is its Bezier curve") {
    const auto bezier = bezier_curves(with({Sketch::Bezier{{0, 1, 2, 3}}}));
    const auto nurb = bezier_curves(with({Sketch::Nurb{4, {0, 0, 0, 0, 3, 3, 3, 3}, {0, 1, 2, 3}, {}}}));
    REQUIRE(nurb.size() == 1);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(nurb[0][i].u == bezier[0][i].u);
        CHECK(nurb[0][i].v == bezier[0][i].v);
    }
    // Weights may be scaled at will, and weights in geometric progression change only the pace.
    const auto same = bezier_curves(with({Sketch::Nurb{3, {0, 0, 0, 1, 1, 1}, {0, 1, 2}, {3, 6, 12}}}));
    CHECK(static_cast<double>(same[0][1].weight) == Approx(1).epsilon(1e-15));
}

TEST_CASE("sketches: gaps that BRL-CAD does not see are closed, others are reported") {
    CHECK(solid_faults(of(with(closed))).empty());
    Sketch gap = with(closed);
    gap.vertices.push_back({0.0001, 0});
    std::get<Sketch::Line>(gap.curves[3]).end = 4;
    CHECK(solid_faults(of(gap)).empty());
    auto pieces = bezier_curves(gap);
    CHECK(loose_ends(pieces).size() == 2);
    CHECK(close_gaps(pieces).empty());
    CHECK(pieces.size() == 5);
    gap.vertices[4] = {0.1, 0};
    check_fault(of(gap), "its sketch is open at vertex");
    // The same point under two numbers is one.
    gap.vertices[4] = {0, 0};
    CHECK(loose_ends(bezier_curves(gap)).empty());
}

TEST_CASE("sketches: profiles are joined to the axis, and may not cross it", "[promise:scenes]") {
    const auto turned = [](Sketch sketch) { return Revolve{{0, 0, 0}, {0, 0, 2}, {3, 0, 0}, 1, std::move(sketch)}; };
    const Sketch open = with({Sketch::Line{1, 2}});
    CHECK(solid_faults(turned(open)).empty());
    const auto pieces = turned_curves(open);
    REQUIRE(pieces.size() == 3);
    for (std::size_t i = 1; i < 3; ++i) {
        CHECK(pieces[i][0].u == 2);
        CHECK(pieces[i][1].u == 0);
        CHECK(pieces[i][0].v == pieces[i][1].v);
    }
    CHECK(turned_curves(with({Sketch::Line{0, 1}, Sketch::Line{1, 3}})).size() == 2);  // ends on the axis
    check_fault(turned(with({Sketch::Line{0, 3}})), "does not reach out from the axis");
    check_fault(turned(with({Sketch::Arc{2, 0, -1}})), "crosses the axis");
    Revolve bad = turned(open);
    bad.angle = 0;
    check_fault(bad, "the angle must be greater than 0");
    bad.angle = 1, bad.r = {1, 0, 1};
    check_fault(bad, "perpendicular");
    bad.r = {1, 0, 0}, bad.axis = {0, 0, 0};
    check_fault(bad, "the axis has length 0");
}
