// Shape forms: the descriptions of all solids and of their parts, in the order in which JSON writes their members.
#pragma once

#include <numbers>

#include "form/form.hpp"

namespace csgrt::form {

template <>
inline constexpr auto of<Ell> = Form{
    solid("ell", "Ellipsoid: three semi-axes."),
    required({"center", "V"}, &Ell::v, lengths),
    required({"a", "A"}, &Ell::a, lengths),
    required({"b", "B"}, &Ell::b, lengths),
    required({"c", "C"}, &Ell::c, lengths, Spanning<Ell>{{&Ell::a, &Ell::b, &Ell::c}, {"a", "b", "c"}}),
};

template <>
inline constexpr auto of<Tgc> = Form{
    solid("tgc",
          "Truncated general cone: the base ellipse has the semi-axes a and b, the top c (along a) and d (along b)."),
    required({"base", "V"}, &Tgc::v, lengths),
    required({"height", "H"}, &Tgc::h, lengths),
    required({"a", "A"}, &Tgc::a, lengths),
    required({"b", "B"}, &Tgc::b, lengths),
    required({"c", "C"}, &Tgc::c, lengths),
    required({"d", "D"}, &Tgc::d, lengths),
};

template <>
inline constexpr auto of<Arb> = Form{
    solid("arb8"),
    required("vertices", &Arb::vertices, Corners{8},
             "Two opposite faces 0 1 2 3 and 4 5 6 7; vertex 4 + i above vertex i."),
};

template <>
inline constexpr auto of<Plane> = Form{
    part("plane"),
    required("normal", &Plane::normal, normal, nonzero("the normal"), "Outward; of any length but 0."),
    required("distance", &Plane::distance, length, "From the origin, along the normal."),
};

template <>
inline constexpr auto of<Arbn> = Form{
    solid("arbn", "What lies below all planes; it must be bounded."),
    required("planes", &Arbn::planes, List{object<Plane>, 4, Limits::faces}, Items{"planes", " of plane ", nullptr}),
};

template <>
inline constexpr auto of<Half> = Form{
    solid("half", "What lies below a plane."),
    required("normal", Inside{&Half::plane, &Plane::normal}, normal, nonzero("the normal"),
             "Outward; of any length but 0."),
    required("distance", Inside{&Half::plane, &Plane::distance}, length),
};

template <>
inline constexpr auto of<Tor> = Form{
    solid("tor", "Torus."),
    required({"center", "V"}, &Tor::v, lengths),
    required({"axis", "H"}, &Tor::h, vector, nonzero("the axis")),
    required({"radius", "r_a"}, &Tor::r_a, length, positive("the radius"), "Of the circle."),
    required({"tube", "r_h"}, &Tor::r_h, length, positive("the radius of the tube"),
             "Radius of the tube, not greater than that of the circle."),
};

template <>
inline constexpr auto of<Ehy> = Form{
    solid("ehy", "Elliptical hyperboloid."),
    required({"base", "V"}, &Ehy::v, lengths),
    required({"height", "H"}, &Ehy::h, lengths, nonzero("the height"), "From the base to the apex."),
    required({"a", "A"}, &Ehy::a, direction, Across{"the direction a", &Ehy::h, "the height"},
             "Direction of the semi-axis r1, perpendicular to the height."),
    required({"r1", "r_1"}, &Ehy::r_1, length, positive("the semi-axis r1")),
    required({"r2", "r_2"}, &Ehy::r_2, length, positive("the semi-axis r2")),
    required({"c", "c"}, &Ehy::c, length, positive("c, the distance from the apex to the asymptotes,"),
             "From the apex to the vertex of the asymptotic cone."),
};

template <>
inline constexpr auto of<Part> = Form{
    solid("part", "Two balls and the cone that touches both."),
    required({"base", "V"}, &Part::v, lengths, "Centre of the first ball."),
    required({"height", "H"}, &Part::h, lengths, "To the centre of the second."),
    required({"radius", "r_v"}, &Part::r_v, length, not_negative("the radius"), "Of the first ball."),
    required({"top_radius", "r_h"}, &Part::r_h, length, not_negative("the radius at the top"), "Of the second."),
};

template <>
inline constexpr auto of<Epa> = Form{
    solid("epa", "Elliptic paraboloid."),
    required({"base", "V"}, &Epa::v, lengths),
    required({"height", "H"}, &Epa::h, lengths, nonzero("the height"), "From the base to the apex."),
    required({"a", "A"}, &Epa::a, direction, Across{"the direction a", &Epa::h, "the height"},
             "Direction of the semi-axis r1, perpendicular to the height."),
    required({"r1", "r_1"}, &Epa::r_1, length, positive("the semi-axis r1")),
    required({"r2", "r_2"}, &Epa::r_2, length, positive("the semi-axis r2")),
};

template <>
inline constexpr auto of<Rpc> = Form{
    solid("rpc", "Parabolic cylinder."),
    required({"base", "V"}, &Rpc::v, lengths, "Middle of the straight edge of one end."),
    required({"height", "H"}, &Rpc::h, lengths, nonzero("the height"), "Along the cylinder."),
    required({"b", "B"}, &Rpc::b, lengths, Across{"the vector b", &Rpc::h, "the height"},
             "From the edge to the vertex of the curve, perpendicular to the height."),
    required({"half_width", "r"}, &Rpc::r, length, positive("half the width"), "Of the flat side."),
};

template <>
inline constexpr auto of<Rhc> = Form{
    solid("rhc", "Hyperbolic cylinder."),
    required({"base", "V"}, &Rhc::v, lengths, "Middle of the straight edge of one end."),
    required({"height", "H"}, &Rhc::h, lengths, nonzero("the height"), "Along the cylinder."),
    required({"b", "B"}, &Rhc::b, lengths, Across{"the vector b", &Rhc::h, "the height"},
             "From the edge to the vertex of the curve, perpendicular to the height."),
    required({"half_width", "r"}, &Rhc::r, length, positive("half the width"), "Of the flat side."),
    required({"c", "c"}, &Rhc::c, length, positive("c, the distance from the vertex to the asymptotes,"),
             "From the vertex of the hyperbola to that of its asymptotes."),
};

template <>
inline constexpr auto of<Eto> = Form{
    solid("eto", "An ellipse turned about an axis."),
    required({"center", "V"}, &Eto::v, lengths),
    required({"axis", "N"}, &Eto::n, vector, nonzero("the axis")),
    required({"radius", "r"}, &Eto::r, length, positive("the radius"),
             "Of the circle on which the ellipse's centre goes round."),
    required({"c", "C"}, &Eto::c, lengths, nonzero("the semi-axis c"),
             "Semi-axis of the ellipse, in the plane of the axis and a radius."),
    required({"d", "r_d"}, &Eto::r_d, length, positive("the semi-axis d"), "Length of the other semi-axis."),
};

template <>
inline constexpr auto of<Hyp> = Form{
    solid("hyp", "Hyperboloid of one sheet."),
    required({"base", "V"}, &Hyp::v, lengths, "Centre of the first ellipse."),
    required({"height", "H"}, &Hyp::h, lengths, nonzero("the height"), "To the centre of the other."),
    required({"a", "A"}, &Hyp::a, lengths, Across{"the semi-axis a", &Hyp::h, "the height"},
             "Semi-axis at both ends, perpendicular to the height."),
    required({"b", "b"}, &Hyp::b, length, positive("the semi-axis b"), "Length of the other semi-axis."),
    required({"neck", "bnr"}, &Hyp::neck, number,
             Bounds{0, 1, false, false, "the neck, a share of a and b,", "must lie between 0 and 1"},
             "Size of the waist, as a part of a and b."),
};

constexpr Bounds exponent(const char* called) {
    static_assert(Limits::least_exponent == 0.01 && Limits::greatest_exponent == 20);
    return {Limits::least_exponent, Limits::greatest_exponent, true, true, called, "must be from 1/100 to 20"};
}

template <>
inline constexpr auto of<Superell> = Form{
    solid("superell", "Superellipsoid: an ellipsoid if n and e are 1, nearer to a box below, an octahedron at 2."),
    required({"center", "V"}, &Superell::v, lengths),
    required({"a", "A"}, &Superell::a, lengths),
    required({"b", "B"}, &Superell::b, lengths),
    required({"c", "C"}, &Superell::c, lengths,
             Spanning<Superell>{{&Superell::a, &Superell::b, &Superell::c}, {"a", "b", "c"}}),
    filled({"n", "n"}, &Superell::n, number, exponent("the exponent n"), "Of the profile, towards c."),
    filled({"e", "e"}, &Superell::e, number, exponent("the exponent e"), "Of the outline, in the plane of a and b."),
};

template <>
inline constexpr auto of<Hrt> = Form{
    solid("hrt", "Heart."),
    required({"center", "V"}, &Hrt::v, lengths),
    required({"x", "X"}, &Hrt::x, lengths),
    required({"y", "Y"}, &Hrt::y, lengths),
    required({"z", "Z"}, &Hrt::z, lengths, Spanning<Hrt>{{&Hrt::x, &Hrt::y, &Hrt::z}, {"x", "y", "z"}}),
    optional({"d", "d"}, &Hrt::d, length, "Distance of the cusps; kept for conversion."),
};

template <>
inline constexpr auto of<Metaball::Point> = Form{
    part("metaball_point"),
    required("position", &Metaball::Point::position, lengths),
    required("strength", &Metaball::Point::strength, length, positive("the strength"),
             "A length: how far the point's field reaches."),
    optional("softness", &Metaball::Point::softness, number, "Of a blob."),
};
template <>
inline Metaball::Point usual() {
    return {.softness = 1};
}

template <>
inline constexpr auto of<Metaball> = Form{
    solid("metaball", "Where the fields of the points add up to the threshold or more."),
    filled("method", &Metaball::method, Words<3>{{"metaball", "isopotential", "blob"}},
           "How a field falls off with the distance."),
    filled("threshold", &Metaball::threshold, number, positive("the threshold")),
    required("points", &Metaball::points, List{object<Metaball::Point>, 1},
             Items{"points", " of point ", "it has no points"}),
};

template <>
inline constexpr auto of<Pipe::Point> = Form{
    part("pipe_point"),
    required("position", &Pipe::Point::position, lengths),
    required("outer", &Pipe::Point::outer, length, positive("the outer diameter"), "Outer diameter."),
    optional("inner", &Pipe::Point::inner, length, not_negative("the inner diameter"), "Inner diameter; 0: solid."),
    optional("bend", &Pipe::Point::bend, length,
             "Radius of the centre line where the pipe turns: half the outer diameter or more."),
};

template <>
inline constexpr auto of<Pipe> = Form{
    solid("pipe", "A tube of changing width through its points, with round bends."),
    required("points", &Pipe::points, List{object<Pipe::Point>, 2, Limits::pipe_points},
             Items{"points", " at point ", "it has fewer than 2 points"}),
};

template <>
inline constexpr auto of<Cline> = Form{
    solid("cline", "Cylinder along a line, or a tube with a wall."),
    required({"base", "V"}, &Cline::v, lengths),
    required({"height", "H"}, &Cline::h, lengths, nonzero("the height")),
    required({"radius", "R"}, &Cline::radius, length, positive("the radius")),
    optional({"thickness", "T"}, &Cline::thickness, length, not_negative("the thickness"), "Of the wall; 0: solid."),
};

template <>
inline constexpr auto of<Bot> = Form{
    solid("bot", "Triangle mesh."),
    filled("mode", &Bot::mode, Words<4>{{"surface", "volume", "plate", "plate_nocos"}},
           "surface has no inside; of plates, each face has a thickness, for plate_nocos along the ray."),
    optional("orientation", &Bot::orientation, Words<3>{{"unoriented", "counterclockwise", "clockwise"}}),
    required("vertices", &Bot::vertices, List{lengths}),
    required("faces", &Bot::faces, List{triangle, 1}),
    optional("thickness", &Bot::thickness, PerFace{length}, not_negative(),
             "Of plates: one for all faces, or one a face."),
    optional("append", &Bot::append, PerFace{byte},
             "Of plates: one for all faces, or one a face. 1: behind the face; 0: half on each side, as if not given."),
    optional("normals", &Bot::normals, List{vector}, "Kept for conversion."),
    optional("face_normals", &Bot::face_normals, List{triangle}, "Kept for conversion."),
};

template <>
inline constexpr auto of<Ars> = Form{
    solid("ars", "Closed surface through curves of equal length, each closed by its first point."),
    required("curves", &Ars::curves, List{List{lengths, 3}, 2}),
};

template <>
inline constexpr auto of<Nmg> = Form{
    solid("nmg", "Polyhedron with flat faces."),
    required("vertices", &Nmg::vertices, List{lengths}),
    required("faces", &Nmg::faces, List{Loops{}, 1},
             "Each a loop of vertices, or a list of loops: the outline, then holes."),
};

inline constexpr const char* file_help = "Where the cells came from; csgrt does not read it.";

template <>
inline constexpr auto of<Ebm> = Form{
    solid("ebm", "Cells of a picture, extruded along z."),
    required("width", &Ebm::width, count, "Cells along x."),
    required("depth", &Ebm::depth, count, "Cells along y."),
    required("height", &Ebm::height, length, positive("the height"), "A length."),
    optional("matrix", &Ebm::matrix, Placement{{true, true, false, true}},
             "Turns cells along x and y, and lengths along z, into lengths. Not given: cells of one unit."),
    optional("file", &Ebm::file, text, file_help),
    required("cells", &Ebm::cells, Cells{255, true}, "Row by row from y = 0; other than 0 is solid."),
};

template <>
inline constexpr auto of<Vol> = Form{
    solid("vol", "Cells of a volume: those with values from low to high are solid."),
    required("width", &Vol::width, count, "Cells along x."),
    required("depth", &Vol::depth, count, "Cells along y."),
    required("height", &Vol::height, count, "Cells along z."),
    required("cell", &Vol::cell, lengths, "Size of one cell."),
    required("low", &Vol::low, byte),
    optional("high", &Vol::high, byte),
    optional("matrix", &Vol::matrix, Placement{{false, false, false, true}}, "Turns lengths into lengths."),
    optional("file", &Vol::file, text, file_help),
    required("cells", &Vol::cells, Cells{255, true}, "Row by row from y = 0, layer by layer from z = 0."),
};

template <>
inline constexpr auto of<Dsp> = Form{
    solid("dsp", "Terrain: heights at the corners of a grid, solid down to z = 0."),
    required("width", &Dsp::width, count, "Heights along x."),
    required("depth", &Dsp::depth, count, "Heights along y."),
    optional("smooth", &Dsp::smooth, flag, "Kept for conversion."),
    optional("cut", &Dsp::cut, Words<3>{{"adaptive", "lower_left", "upper_left"}}, "Which diagonal splits a cell."),
    optional("matrix", &Dsp::matrix, Placement{{true, true, true, true}},
             "Turns cells along x and y, and steps of height, into lengths. Not given: one unit each."),
    optional("file", &Dsp::file, text, file_help),
    required("heights", &Dsp::heights, Cells{65535, false}, "Row by row from y = 0."),
};

// ---- Sketches. A curve's first key tells its type; the sketch holds the flags of reversed curves. ----

inline constexpr auto reversed = optional("reversed", nothing, flag, "Kept for conversion.");

template <>
inline constexpr auto of<Sketch::Line> = Form{
    part("line"),
    required("line", itself, Ends{}, "Start and end."),
    reversed,
};

template <>
inline constexpr auto of<Sketch::Arc> = Form{
    part("arc"),
    required("arc", itself, Ends{}, "Start and end."),
    required("radius", &Sketch::Arc::radius, length, "Below 0: a full circle around the end, through the start."),
    optional("center_left", &Sketch::Arc::center_left, flag,
             "The centre lies to the left of the way from start to end."),
    optional("clockwise", &Sketch::Arc::clockwise, flag, "The way from start to end."),
    reversed,
};

/// An arc's second form in a file: a circle around `start` through `end`.
struct Circle {
    std::uint32_t start = 0, end = 0;
};
template <>
inline constexpr auto of<Circle> = Form{
    part("circle"),
    required("circle", itself, Ends{}, "The centre, and a vertex on the circle."),
    reversed,
};

template <>
inline constexpr auto of<Sketch::Bezier> = Form{
    part("bezier"),
    required("bezier", &Sketch::Bezier::points, List{count, 2, Limits::curve_degree + 1}, "Control points."),
    reversed,
};

template <>
inline constexpr auto of<Sketch::Nurb> = Form{
    part("nurb"),
    required("nurb", &Sketch::Nurb::points, List{count, 2}, "Control points."),
    required("order", &Sketch::Nurb::order, count, Bounds{2, Limits::curve_degree + 1, true, true, "", ""},
             "The degree and 1."),
    required("knots", &Sketch::Nurb::knots, List{number, 4},
             "As many as control points and order together; the first and the last stand there order times."),
    optional("weights", &Sketch::Nurb::weights, List{number}, positive(), "One a control point; none: not rational."),
    reversed,
};

template <>
inline constexpr auto of<Sketch> = Form{
    part("sketch", "A plane outline: curves over common vertices. What lies inside an odd number of times is inside."),
    optional("name", &Sketch::name, text, "Of the object that it came from."),
    required("vertices", &Sketch::vertices, List{Uv{}, 1}, "Each is [u, v]."),
    required("curves", itself, Curves{}),
};

template <>
inline constexpr auto of<Extrude> = Form{
    solid("extrude", "What a sketch encloses, in the plane base + u a + v b, moved along the height."),
    required("base", &Extrude::v, lengths),
    required("height", &Extrude::h, lengths, nonzero("the height")),
    filled("a", &Extrude::a, vector, nonzero("the vector a"), "[1, 0, 0] if not given."),
    filled("b", &Extrude::b, vector, nonzero("the vector b"), "[0, 1, 0] if not given."),
    required("sketch", &Extrude::sketch, object<Sketch>),
};
template <>
inline Extrude usual() {
    return {.a = {1, 0, 0}, .b = {0, 1, 0}};
}

/// The relative rounding error by which an angle may exceed a full turn.
constexpr double turn_rounding = 1e-9;

template <>
inline constexpr auto of<Revolve> = Form{
    solid("revolve", "A sketch turned about an axis; its v runs along the axis."),
    required("base", &Revolve::v, lengths),
    required("axis", &Revolve::axis, vector, nonzero("the axis")),
    required("r", &Revolve::r, vector, Across{"the direction r", &Revolve::axis, "the axis"},
             "Where u points: perpendicular to the axis."),
    filled("angle", &Revolve::angle, Turn{},
           Bounds{0, 2 * std::numbers::pi*(1 + turn_rounding), false, true, "the angle",
                  "must be greater than 0 and at most a full turn"},
           "Degrees."),
    optional("radians", nothing, number, positive(), "The angle, where no number of degrees gives its bits."),
    required("sketch", &Revolve::sketch, object<Sketch>),
};

template <>
inline constexpr auto of<Unsupported> = Form{
    solid("unsupported", "A solid of BRL-CAD's that csgrt knows by name only. It cannot be rendered."),
    required("was", &Unsupported::type, name),
};

}  // namespace csgrt::form
