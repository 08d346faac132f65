// Sketches of the older text form, and the solids that they make.
//
//     d name V A B vertices curves   a line with u and v of all vertices, then for each curve
//                                    L reversed start end
//                                    A reversed start end radius center-left clockwise
//                                    B reversed degree                            a line of vertices
//                                    N reversed order type knots points           lines of knots, vertices, weights?
//     e name sketch key-point V H A B
#include "formats/brlcad/v4/solids.hpp"

namespace csgrt {

namespace {

constexpr int is_rational = 1;  // a bit in the type of a nurb's points

Line data_line(LineReader& lines) {
    const Line line = lines.peek();
    if (lines.at_end() || !line.text.starts_with(' ')) {
        throw Fault{line.offset, "the sketch ends early: a line of vertices or curves is missing", {}};
    }
    return lines.take();
}

std::uint32_t vertex(Fields& fields, std::size_t end) {
    const std::size_t at = fields.offset();
    const int index = fields.integer("a vertex", 0);
    if (static_cast<std::size_t>(index) >= end) {
        throw Fault{at,
                    "there is no number " + std::to_string(index) + ": there are only " + std::to_string(end) +
                        ", counted from 0",
                    {}};
    }
    return static_cast<std::uint32_t>(index);
}

double number(Fields& fields, const char* what) {
    const Field field = fields.next(what);
    return read_number(field.text, field.offset);
}

/// Reads a line of exactly `count` vertices.
std::vector<std::uint32_t> vertices_of(const Line& line, std::int64_t count, std::size_t end) {
    Fields fields(line);
    std::vector<std::uint32_t> out;
    for (std::int64_t i = 0; i < count; ++i) out.push_back(vertex(fields, end));
    fields.end();
    return out;
}

std::vector<double> numbers_of(const Line& line, std::int64_t count, const char* what) {
    Fields fields(line);
    std::vector<double> out;
    for (std::int64_t i = 0; i < count; ++i) out.push_back(number(fields, what));
    fields.end();
    return out;
}

Sketch::Curve nurb(Fields& fields, LineReader& lines, std::size_t vertices) {
    const std::size_t start = fields.offset();
    Sketch::Nurb curve;
    curve.order = static_cast<std::uint32_t>(fields.integer("the order", 1));
    const int type = fields.integer("the type of the points");
    const std::int64_t knots = fields.integer("the number of knots", 0);
    const std::int64_t points = fields.integer("the number of points", 0);
    fields.end();
    if (knots != points + std::int64_t{curve.order}) {
        throw Fault{start,
                    std::to_string(points) + " points and order " + std::to_string(curve.order) + " do not go with " +
                        std::to_string(knots) + " knots",
                    {}};
    }
    curve.knots = numbers_of(data_line(lines), knots, "a knot");
    curve.points = vertices_of(data_line(lines), points, vertices);
    if ((type & is_rational) != 0) curve.weights = numbers_of(data_line(lines), points, "a weight");
    return curve;
}

Sketch::Curve read_curve(char letter, const Field& at, Fields& fields, LineReader& lines, std::size_t vertices) {
    if (letter == 'N') return nurb(fields, lines, vertices);
    if (letter == 'B') {
        const std::int64_t degree = fields.integer("the degree", 1);
        fields.end();
        return Sketch::Bezier{vertices_of(data_line(lines), degree + 1, vertices)};
    }
    if (letter != 'L' && letter != 'A') throw Fault{at.offset, quoted(at.text) + " is no curve", "curves are L A B N"};
    const std::uint32_t start = vertex(fields, vertices), end = vertex(fields, vertices);
    if (letter == 'L') {
        fields.end();
        return Sketch::Line{start, end};
    }
    Sketch::Arc arc{start, end};
    arc.radius = number(fields, "the radius");
    arc.center_left = fields.integer("the side of the center") != 0;
    arc.clockwise = fields.integer("the orientation") != 0;
    fields.end();
    return arc;
}

}  // namespace

Sketch read_v4_sketch(Fields& fields, LineReader& lines) {
    fields.numbers<9>("numbers of the sketch's plane");
    const int vertices = fields.integer("the number of vertices", 0);
    const int curves = fields.integer("the number of curves", 0);
    fields.end();
    Sketch sketch;
    Fields line(data_line(lines));
    for (int i = 0; i < vertices; ++i) {
        const auto uv = line.numbers<2>("coordinates of a vertex");
        sketch.vertices.push_back({uv[0], uv[1]});
    }
    line.end();
    for (int i = 0; i < curves; ++i) {
        Fields curve(data_line(lines));
        const Field letter = curve.next("the curve's letter");
        sketch.reversed.push_back(curve.integer("whether the curve is reversed") != 0);
        const char kind = letter.text.size() == 1 ? letter.text[0] : '?';
        sketch.curves.push_back(read_curve(kind, letter, curve, lines, sketch.vertices.size()));
    }
    return sketch;
}

Shape read_v4_extrude(Fields& fields) {
    Extrude solid;
    solid.sketch.name = fields.next("the sketch's name").text;
    fields.integer("the key point");
    const auto p = fields.numbers<12>("numbers of the extrude");
    fields.end();
    solid.v = {p[0], p[1], p[2]};
    solid.h = {p[3], p[4], p[5]};
    solid.a = {p[6], p[7], p[8]};
    solid.b = {p[9], p[10], p[11]};
    return solid;
}

}  // namespace csgrt
