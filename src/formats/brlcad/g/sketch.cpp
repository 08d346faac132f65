// Sketches of binary databases, and the solids that they make.
//
//     sketch   V, A, B: points  vertices, curves: counts  u, v of each vertex  curves
//              a word for each curve: is it reversed?
//     curve    four letters: lseg  start, end
//                            carc  start, end, clockwise, center left  radius
//                            bezi  degree  degree + 1 vertices
//                            nurb  order, type of points, knots: words  knots  points: count  points  weights?
//     extrude  V, H, A, B  a word  the sketch's name          revolve  V, axis, R, angle  the sketch's name
#include "formats/brlcad/g/solids.hpp"
#include "formats/brlcad/values.hpp"

namespace csgrt {

namespace {

constexpr std::uint32_t is_rational = 1;  // a bit in the type of a nurb's points

Sketch::Curve line(ByteReader& b, std::size_t vertices) {
    const std::uint32_t start = b.index(vertices, "the start of a line");
    return Sketch::Line{start, b.index(vertices, "the end of a line")};
}

Sketch::Curve arc(ByteReader& b, std::size_t vertices) {
    Sketch::Arc arc;
    arc.start = b.index(vertices, "the start of an arc");
    arc.end = b.index(vertices, "the end of an arc");
    arc.clockwise = b.word("an arc's orientation") != 0;
    arc.center_left = b.word("the side of an arc's center") != 0;
    arc.radius = b.real("an arc's radius");
    return arc;
}

std::vector<std::uint32_t> indices(ByteReader& b, std::uint64_t count, std::size_t vertices, const char* what) {
    if (count > b.left() / word_size) {
        throw Fault{b.offset(),
                    std::string(what) + ": " + std::to_string(count) + " do not fit into the " +
                        std::to_string(b.left()) + " bytes that are left",
                    {}};
    }
    std::vector<std::uint32_t> out(static_cast<std::size_t>(count));
    for (std::uint32_t& index : out) index = b.index(vertices, what);
    return out;
}

Sketch::Curve bezier(ByteReader& b, std::size_t vertices) {
    const std::uint64_t degree = b.word("a curve's degree");
    return Sketch::Bezier{indices(b, degree + 1, vertices, "a point of a curve")};
}

Sketch::Curve nurb(ByteReader& b, std::size_t vertices) {
    Sketch::Nurb curve;
    curve.order = b.word("a curve's order");
    const std::uint32_t type = b.word("the type of a curve's points");
    const std::size_t knots_at = b.offset();
    curve.knots.resize(b.count(real_size, "the number of knots"));
    for (double& knot : curve.knots) knot = b.real("a knot");
    curve.points = indices(b, b.count(word_size, "the number of a curve's points"), vertices, "a point of a curve");
    if (curve.knots.size() != curve.points.size() + std::uint64_t{curve.order}) {
        throw Fault{knots_at,
                    std::to_string(curve.points.size()) + " points and order " + std::to_string(curve.order) +
                        " do not go with " + std::to_string(curve.knots.size()) + " knots",
                    {}};
    }
    if ((type & is_rational) != 0) {
        curve.weights.resize(curve.points.size());
        for (double& weight : curve.weights) weight = b.real("a weight");
    }
    return curve;
}

Sketch::Curve read_curve(ByteReader& b, std::size_t vertices) {
    const std::size_t at = b.offset();
    const std::string_view type = b.take(4, "the type of a curve");
    if (type == "lseg") return line(b, vertices);
    if (type == "carc") return arc(b, vertices);
    if (type == "bezi") return bezier(b, vertices);
    if (type == "nurb") return nurb(b, vertices);
    throw Fault{at, quoted(type) + " is no curve", {}};
}

}  // namespace

/// The plane of a sketch is ignored, because the solids that use the sketch have their own planes.
Sketch read_g_sketch(ByteReader& b) {
    for (const char* what : {"V", "A", "B"}) b.vec3(what);
    const std::uint32_t vertices = b.count(2 * real_size, "the number of vertices");
    const std::uint32_t curves = b.count(word_size, "the number of curves");
    Sketch sketch;
    for (std::uint32_t i = 0; i < vertices; ++i) {
        const double u = b.real("a vertex");
        sketch.vertices.push_back({u, b.real("a vertex")});
    }
    for (std::uint32_t i = 0; i < curves; ++i) sketch.curves.push_back(read_curve(b, vertices));
    for (std::uint32_t i = 0; i < curves; ++i) sketch.reversed.push_back(b.word("whether a curve is reversed") != 0);
    return sketch;
}

Shape read_g_extrude(ByteReader& b) {
    Extrude solid{b.vec3("V"), b.vec3("H"), b.vec3("A"), b.vec3("B"), {}};
    b.word("the key point");
    solid.sketch.name = b.name("the sketch's name");
    return solid;
}

Shape read_g_revolve(ByteReader& b) {
    Revolve solid{b.vec3("V"), b.vec3("the axis"), b.vec3("R"), b.real("the angle"), {}};
    solid.sketch.name = b.name("the sketch's name");
    return solid;
}

}  // namespace csgrt
