// Which outlines enclose something, and what is said of those that do not.
#include "catch.hpp"

#include <cmath>
#include <numbers>

#include "scene/faults/check_faults.hpp"
#include "scene/faults/sketches.hpp"

using namespace csgrt;

namespace {

using Curves = std::vector<Sketch::Curve>;
using Points = std::vector<Sketch::Point>;
using Line = Sketch::Line;
using Arc = Sketch::Arc;
using Bezier = Sketch::Bezier;
using Nurb = Sketch::Nurb;

Sketch sketch(Points points, Curves curves) {
    const std::vector<std::uint8_t> reversed(curves.size(), 0);
    return {"", std::move(points), std::move(curves), reversed};
}
Extrude extrude(Points points, Curves curves) {
    return {{}, {0, 0, 5}, {1, 0, 0}, {0, 1, 0}, sketch(std::move(points), std::move(curves))};
}
Revolve revolve(Points points, Curves curves, double angle = 1) {
    return {{}, {0, 0, 1}, {1, 0, 0}, angle, sketch(std::move(points), std::move(curves))};
}

const Points square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
const Curves around = {Line{0, 1}, Line{1, 2}, Line{2, 3}, Line{3, 0}};

}  // namespace

TEST_CASE("solid faults: extruded outlines", "[promise:refusals]") {
    check_sound(extrude(square, around));
    check_sound(extrude({{0, 0}, {4, 0}, {4, 4}, {0, 0}}, {Line{0, 1}, Line{1, 2}, Line{2, 3}}));  // closed by place
    check_sound(extrude(square, {Line{0, 1}, Arc{1, 2, 2, true, false}, Bezier{{2, 3, 0}}}));
    check_sound(extrude(square, {Arc{0, 1, -1, false, false}}));
    check_sound(extrude(square, {Nurb{3, {0, 0, 0, 1, 2, 2, 2}, {0, 1, 2, 3}, {}}, Line{3, 0}}));
    check_fault(extrude(square, {}), "no curves");
    check_fault(extrude(square, {Line{0, 1}, Line{1, 2}, Line{2, 3}}), "open at vertex 0");
    check_fault(extrude(square, {Line{0, 4}}), "curve 0 of its sketch uses vertex 4");
    Extrude solid = extrude(square, around);
    solid.h = {1, 1, 0};
    check_fault(solid, "lie in one plane");
    solid.a = {};
    check_fault(solid, "the vector a has length 0");
    solid = extrude({{0, 0}, {4, 0}, {4, infinite}, {0, 4}}, around);
    check_fault(solid, "vertex 2 of its sketch has a number that is not finite");
    solid = extrude(square, around);
    solid.sketch.reversed.pop_back();
    check_fault(solid, "directions for 3");
}

TEST_CASE("solid faults: more curves than the limit", "[promise:refusals][promise:limits]") {
    const auto many = [](std::uint32_t count) {
        Points points;
        Curves curves;
        for (std::uint32_t i = 0; i < count; ++i) {
            const double turn = 2 * std::numbers::pi * i / count;
            points.push_back({std::cos(turn), std::sin(turn)});
            curves.push_back(Line{i, (i + 1) % count});
        }
        return extrude(std::move(points), std::move(curves));
    };
    check_sound(many(Limits::curves));
    check_fault(many(Limits::curves + 1), "at most 100000");
}

TEST_CASE("solid faults: arcs", "[promise:refusals]") {
    check_sound(extrude(square, {Arc{0, 1, 2, false, false}, Line{1, 0}}));  // half a circle
    check_sound(extrude(square, {Arc{0, 1, 2 / (1 + 0.99e-5), false, false}, Line{1, 0}}));
    check_fault(extrude(square, {Arc{0, 1, 2 / (1 + 1.01e-5), false, false}, Line{1, 0}}), "too small a radius");
    check_fault(extrude(square, {Arc{0, 1, 1.9, false, false}, Line{1, 0}}),
                "too small a radius, 1.9: its ends are 4 apart, which is more than the diameter by 0.0526316 of it; at "
                "most 1e-05 is taken for a half circle");
    check_fault(extrude(square, {Arc{0, 1, 0, false, false}, Line{1, 0}}), "an arc of radius 0");
    check_fault(extrude(square, {Arc{1, 1, 3, false, false}}), "from a place to itself");
    check_fault(extrude(square, {Arc{1, 1, -1, false, false}}), "a circle of radius 0");
    check_fault(extrude(square, {Arc{0, 1, not_a_number, false, false}, Line{1, 0}}), "radius that is not finite");
}

TEST_CASE("solid faults: bezier and nurb curves", "[promise:refusals]") {
    const auto closed = [](Sketch::Curve curve) { return extrude(square, {std::move(curve), Line{3, 0}}); };
    check_fault(closed(Bezier{{0}}), "fewer than 2 points");
    check_fault(closed(Bezier{std::vector<std::uint32_t>(14, 0)}), "is of degree 13; at most 12");
    check_fault(closed(Bezier{{0, 9, 3}}), "uses vertex 9");
    check_fault(closed(Nurb{1, {0, 1}, {0}, {}}), "must be of order 2 or more");
    check_fault(closed(Nurb{14, {}, std::vector<std::uint32_t>(20, 0), {}}), "is of degree 13; at most 12");
    check_fault(closed(Nurb{UINT32_MAX, {}, {0, 3}, {}}), "at most 12");
    check_fault(closed(Nurb{3, {0, 0, 1, 1}, {0, 3}, {}}), "fewer points than its order");
    check_fault(closed(Nurb{2, {0, 0, 1}, {0, 3}, {}}), "needs 4 knots");
    check_fault(closed(Nurb{2, {0, 0, 1, 1}, {0, 3}, {1}}), "needs a weight for each of its 2 points");
    check_fault(closed(Nurb{2, {0, 0, 1, 1}, {0, 3}, {1, 0}}), "a weight that is not above 0");
    check_fault(closed(Nurb{2, {0, 0, 1, 1}, {0, 3}, {1, infinite}}), "a weight that is not above 0");
    check_fault(closed(Nurb{2, {0, 0, not_a_number, 1}, {0, 3}, {}}), "a knot that is not finite");
    check_fault(closed(Nurb{2, {0, 0, 2, 1, 1}, {0, 1, 3}, {}}), "knots that decrease");
    check_fault(closed(Nurb{2, {0, 1, 2, 3}, {0, 3}, {}}), "must end at its first and last points");
    check_fault(closed(Nurb{2, {0, 0, 0, 1, 1}, {0, 1, 3}, {}}), "too many equal knots at an end");
    check_fault(closed(Nurb{2, {0, 0, 1, 1, 1}, {0, 1, 3}, {}}), "too many equal knots at an end");
    check_fault(closed(Nurb{2, {0, 0, 0, 0}, {0, 3}, {}}), "too many equal knots at an end");
    check_fault(closed(Nurb{2, {0, 0, 1, 1, 2, 2}, {0, 1, 2, 3}, {}}), "is broken by 2 equal knots");
    check_sound(closed(Nurb{2, {0, 0, 1, 1}, {0, 3}, {1, 2}}));
    check_sound(closed(Nurb{3, {0, 0, 0, 1, 1, 2, 2, 2}, {0, 1, 2, 1, 3}, {}}));
}

TEST_CASE("solid faults: revolved outlines") {
    const double full = 2 * std::numbers::pi;
    check_sound(revolve(square, around, full));
    check_sound(revolve(square, {Line{0, 1}, Line{1, 2}, Line{2, 3}}));  // ends on the axis
    check_sound(revolve(square, {Line{0, 1}, Line{1, 2}}));              // joined to the axis
    check_fault(revolve(square, around, 0), "the angle must be greater than 0");
    check_fault(revolve(square, around, full + 0.1), "at most a full turn");
    check_fault(revolve({{-1, 0}, {4, 0}, {4, 4}, {0, 4}}, around), "curve 0 of its sketch crosses the axis");
    check_sound(revolve({{-1e-12, 0}, {4, 0}, {4, 4}, {0, 4}}, around));  // rounded
    Revolve solid = revolve(square, around);
    solid.r = {1, 0, 1};
    check_fault(solid, "must be perpendicular to the axis");
    solid.axis = solid.r = {};
    check_fault(solid, "the axis has length 0", 2);
}

TEST_CASE("solid faults: curves that pass the axis between their ends") {
    const Points points = {{1, 0}, {1, 4}, {-3, 2}, {-0.9, 2}};
    const auto closed = [&](Sketch::Curve curve) { return revolve(points, {std::move(curve), Line{1, 0}}); };
    // Half circles of radius 2 about (1, 2): to the left they reach u = -1.
    check_fault(closed(Arc{0, 1, 2, true, true}), "curve 0 of its sketch crosses the axis");
    check_sound(closed(Arc{0, 1, 2, true, false}));
    // Of radius 2.5, the short way reaches u = 0, the long one u = -3.
    check_sound(closed(Arc{0, 1, 2.5, false, true}));
    check_fault(closed(Arc{0, 1, 2.4, false, true}), "crosses the axis");
    check_fault(closed(Arc{0, 1, 2.5, true, true}), "crosses the axis");
    check_sound(closed(Arc{0, 1, 2.5, true, false}));
    check_fault(revolve(points, {Arc{0, 1, -1, false, false}}), "crosses the axis");
    check_fault(closed(Bezier{{0, 2, 1}}), "crosses the axis");
    check_sound(closed(Bezier{{0, 3, 1}}));  // u = 0.05 in the middle
    check_fault(closed(Nurb{3, {0, 0, 0, 1, 1, 1}, {0, 3, 1}, {1, 9, 1}}), "crosses the axis");
    check_sound(closed(Nurb{3, {0, 0, 0, 1, 1, 1}, {0, 2, 1}, {1, 0.1, 1}}));
}

TEST_CASE("solid faults: ends of curves meet by place, not by number") {
    const Sketch figure =
        sketch({{0, 0}, {1, 0}, {2, 0}, {0.0, -0.0}, {5, 5}}, {Line{0, 1}, Line{1, 2}, Line{2, 3}, Line{4, 4}});
    CHECK(open_ends(figure).empty());
    CHECK(open_ends(sketch(figure.vertices, {Line{3, 1}, Line{1, 4}})) == std::vector<std::uint32_t>{3, 4});
}
