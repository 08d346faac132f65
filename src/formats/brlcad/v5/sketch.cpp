// Sketches of the newer text form, and the solids that they make.

#include "formats/brlcad/v5/solids.hpp"
#include "formats/brlcad/values.hpp"

namespace csgrt {

namespace {

std::uint32_t vertex(Parameters& p, std::string_view key, std::size_t vertices) {
    const std::size_t offset = p.place_of(key);
    const std::vector<std::uint32_t> one = p.indices(key, vertices);
    if (one.size() != 1) throw Fault{offset, std::string(key) + " is not one vertex", {}};
    return one[0];
}

Sketch::Curve line(Parameters& p, std::size_t vertices) {
    const std::uint32_t start = vertex(p, "S", vertices);
    return Sketch::Line{start, vertex(p, "E", vertices)};
}

Sketch::Curve arc(Parameters& p, std::size_t vertices) {
    Sketch::Arc arc;
    arc.start = vertex(p, "S", vertices);
    arc.end = vertex(p, "E", vertices);
    arc.radius = p.number("R");
    arc.center_left = p.integer("L", 0, 1) != 0;
    arc.clockwise = p.integer("O", 0, 1) != 0;
    return arc;
}

Sketch::Curve bezier(Parameters& p, std::size_t vertices) {
    const std::size_t offset = p.place_of("D");
    const int degree = p.integer("D", 1, largest_integer);
    Sketch::Bezier curve{p.indices("P", vertices)};
    if (curve.points.size() != static_cast<std::size_t>(degree) + 1) {
        throw Fault{offset,
                    "a curve of degree " + std::to_string(degree) + " has one point more than that, not " +
                        std::to_string(curve.points.size()),
                    {}};
    }
    return curve;
}

Sketch::Curve nurb(Parameters& p, std::size_t vertices) {
    Sketch::Nurb curve;
    curve.order = p.count("O");
    if (p.has("T")) p.take("T");  // the type of the points, which the weights tell, too
    const std::size_t knots_at = p.place_of("K");
    curve.knots = p.all_numbers("K");
    curve.points = p.indices("P", vertices);
    if (curve.knots.size() != curve.points.size() + curve.order) {
        throw Fault{knots_at,
                    std::to_string(curve.points.size()) + " points and order " + std::to_string(curve.order) +
                        " need " + std::to_string(curve.points.size() + curve.order) + " knots, not " +
                        std::to_string(curve.knots.size()),
                    {}};
    }
    const std::size_t weights_at = p.place_of("W");
    if (p.has("W")) curve.weights = p.all_numbers("W");
    if (!curve.weights.empty() && curve.weights.size() != curve.points.size()) {
        throw Fault{
            weights_at,
            std::to_string(curve.weights.size()) + " weights for " + std::to_string(curve.points.size()) + " points",
            {}};
    }
    return curve;
}

/// Reads {line S 0 E 1}: a type, keys and values.
Sketch::Curve read_curve(const TclWord& word, std::size_t vertices, TclStore& store) {
    std::vector<TclWord> words;
    TclList list(word, store);
    for (TclWord element; list.next(element);) words.push_back(element);
    if (words.empty()) throw Fault{word.offset, "the curve is empty", {}};
    const TclWord& type = words[0];
    Parameters p(type, std::span<const TclWord>(words).subspan(1), store);
    const auto read = [&]() -> Sketch::Curve {
        if (type.text == "line") return line(p, vertices);
        if (type.text == "carc") return arc(p, vertices);
        if (type.text == "bezier") return bezier(p, vertices);
        if (type.text == "nurb") return nurb(p, vertices);
        throw Fault{type.offset, quoted(type.text) + " is no curve", "curves are line, carc, bezier and nurb"};
    };
    Sketch::Curve curve = read();
    p.end();
    return curve;
}

}  // namespace

/// The plane V A B of a sketch is ignored, because the solids that use the sketch have their own planes.
Sketch read_v5_sketch(Parameters& p) {
    for (const std::string_view key : {"V", "A", "B"}) p.vec3(key);
    Sketch sketch;
    for (const auto& point : p.rows<2>("VL")) sketch.vertices.push_back({point[0], point[1]});
    TclList curves(p.take("SL"), p.store());
    for (TclWord curve; curves.next(curve);) {
        sketch.curves.push_back(read_curve(curve, sketch.vertices.size(), p.store()));
    }
    sketch.reversed.resize(sketch.curves.size());
    return sketch;
}

Shape read_v5_extrude(Parameters& p) {
    Extrude solid{p.vec3("V"), p.vec3("H"), p.vec3("A"), p.vec3("B"), {}};
    solid.sketch.name = p.take("S").text;
    if (p.has("K")) p.integer("K", -largest_integer, largest_integer);  // the key point's vertex, for editors
    return solid;
}

Shape read_v5_revolve(Parameters& p) {
    Revolve solid{p.vec3("V"), p.vec3("axis"), p.vec3("R"), p.number("ang"), {}};
    solid.sketch.name = p.take("sk_name").text;
    return solid;
}

}  // namespace csgrt
