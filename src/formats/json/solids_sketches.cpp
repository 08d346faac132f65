#include <numbers>

#include "formats/json/angle.hpp"
#include "formats/json/lists.hpp"
#include "formats/json/solid_readers.hpp"

namespace csgrt {

namespace {

/// Two indices of vertices.
struct Ends {
    std::uint32_t start = 0, end = 0;
};
Ends read_ends(const JsonNode& node) {
    const std::vector<std::uint32_t> ends = read_json_counts(node);
    if (node.is_array() && ends.size() != 2) {
        node.fault("expected 2 indices of vertices, found " + std::to_string(ends.size()));
    }
    return ends.size() == 2 ? Ends{ends[0], ends[1]} : Ends{};
}

Sketch::Curve read_line(const JsonObject& o) {
    const Ends ends = read_ends(o["line"]);
    return Sketch::Line{ends.start, ends.end};
}

Sketch::Curve read_arc(const JsonObject& o) {
    const Ends ends = read_ends(o["arc"]);
    return Sketch::Arc{ends.start, ends.end, o["radius"].length(), o["center_left"].boolean(),
                       o["clockwise"].boolean()};
}

/// A circle is given by its centre and a vertex that it goes through.
Sketch::Curve read_circle(const JsonObject& o) {
    const Ends ends = read_ends(o["circle"]);
    return Sketch::Arc{ends.end, ends.start, -1, false, false};
}

Sketch::Curve read_bezier(const JsonObject& o) { return Sketch::Bezier{read_json_counts(o["bezier"])}; }

Sketch::Curve read_nurb(const JsonObject& o) {
    return Sketch::Nurb{o["order"].count(), read_json_numbers(o["knots"]), read_json_counts(o["nurb"]),
                        read_json_numbers(o["weights"])};
}

using Read = Sketch::Curve (*)(const JsonObject&);
constexpr std::pair<const char*, Read> readers[] = {
    {"line", read_line}, {"arc", read_arc}, {"circle", read_circle}, {"bezier", read_bezier}, {"nurb", read_nurb}};

void read_curve(const JsonNode& node, Sketch& sketch) {
    for (const auto& [name, read] : readers) {
        if (!node.is_object() || find_member(std::get<JsonMembers>(node.value()->data), name) == nullptr) continue;
        const JsonObject o(node, json_form(name));
        sketch.curves.push_back(read(o));
        if (!o.has("reversed")) return;
        sketch.reversed.resize(sketch.curves.size());
        sketch.reversed.back() = o["reversed"].boolean();
        return;
    }
    node.fault(node.is_object() ? "this curve has none of the keys that name one"
                                : std::string("expected a curve, found ") + kind_of(*node.value()),
               R"(a curve is {"line": [start, end]}, {"arc": ...}, {"circle": ...}, {"bezier": ...} or {"nurb": ...})");
}

Sketch read_sketch(const JsonNode& node) {
    const JsonObject o(node, json_form("sketch"));
    Sketch sketch;
    sketch.name = o["name"].string();
    if (o.has("vertices")) {
        for (const JsonNode& item : o["vertices"].items()) {
            const std::vector<double> uv = item.numbers(2);
            const double unit = item.file().unit;
            sketch.vertices.push_back({unit * uv[0], unit * uv[1]});
        }
    }
    if (o.has("curves")) {
        for (const JsonNode& item : o["curves"].items()) read_curve(item, sketch);
        if (!sketch.reversed.empty()) sketch.reversed.resize(sketch.curves.size());
    }
    return sketch;
}

double read_angle(const JsonObject& o) {
    if (o.has("radians")) {
        if (o.has("angle")) o["radians"].fault("an angle is given in degrees, or as 'radians', not both");
        return o["radians"].number();
    }
    return radians_of(o["angle"].number(360));
}

}  // namespace

Shape read_json_extrude(const JsonObject& o) {
    return Extrude{o["base"].lengths(), o["height"].lengths(), o.has("a") ? o["a"].vector() : Vec3{1, 0, 0},
                   o.has("b") ? o["b"].vector() : Vec3{0, 1, 0}, read_sketch(o["sketch"])};
}

Shape read_json_revolve(const JsonObject& o) {
    return Revolve{o["base"].lengths(), o["axis"].vector(), o["r"].vector(), read_angle(o), read_sketch(o["sketch"])};
}

}  // namespace csgrt
