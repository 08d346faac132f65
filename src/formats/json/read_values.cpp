#include <algorithm>

#include "formats/json/angle.hpp"
#include "formats/json/placement.hpp"
#include "formats/json/read_form.hpp"
#include "scene/solids/shape_forms.hpp"

namespace csgrt {

void read_value(const JsonNode& node, form::Axis, Vec3& value) {
    value = node.vector();
    if (node.is_vector() && value == Vec3{}) node.fault("has no direction: all its numbers are 0");
}

void read_value(const JsonNode& node, form::Direction direction, Vec3& value) {
    value = node.direction();
    if (!direction.may_be_zero) check_value(node, form::nonzero());
}

void read_value(const JsonNode& node, form::Uv, Sketch::Point& value) {
    const std::vector<double> uv = node.numbers(2);
    const double unit = node.file().unit;
    value = {unit * uv[0], unit * uv[1]};
}

void read_value(const JsonNode& node, form::Triangle, std::array<std::uint32_t, 3>&) {
    const std::vector<JsonNode> corners = node.items();
    if (node.is_array() && corners.size() != 3)
        node.fault("expected 3 indices, found " + std::to_string(corners.size()));
    for (const JsonNode& corner : corners) corner.count();
}

void read_value(const JsonNode& node, form::Corners corners, std::span<Vec3> value) {
    const std::vector<JsonNode> items = node.items();
    if (node.is_array() && items.size() != corners.count) {
        node.fault("expected " + std::to_string(corners.count) + " vertices, found " + std::to_string(items.size()),
                   items.size() >= 4 && items.size() <= 8
                       ? "the type 'arb" + std::to_string(items.size()) + "' has that many"
                       : "");
    }
    for (std::size_t i = 0; i < items.size(); ++i) {
        const Vec3 vertex = items[i].lengths();
        if (i < value.size()) value[i] = vertex;
    }
}

/// Reads a list of loops, or a list of vertices, which is a face of one loop.
void read_value(const JsonNode& node, form::Loops, std::vector<Nmg::Loop>& value) {
    const form::List loop{form::count};
    const JsonArray* items = node.array();
    if (items != nullptr && !items->empty() && !node.item(0).is_array()) {
        read_value(node, loop, value.emplace_back());
    } else {
        read_value(node, form::List{loop, 0}, value);  // List{loop} would copy `loop`
    }
}

void read_value(const JsonNode& node, form::Cells cells, std::vector<std::uint16_t>& value) {
    value = read_json_cells(node, cells.most, cells.marks);
}

void read_value(const JsonNode& node, form::Cells cells, std::vector<std::uint8_t>& value) {
    const std::vector<std::uint16_t> wide = read_json_cells(node, cells.most, cells.marks);
    value.resize(wide.size());
    std::transform(wide.begin(), wide.end(), value.begin(),
                   [](std::uint16_t c) { return static_cast<std::uint8_t>(c); });
}

namespace {

/// Reads a curve. A circle is given by its centre and a vertex on it.
template <class Curve>
Sketch::Curve read_curve(const JsonNode& node) {
    return read_form<Curve>(node);
}
Sketch::Curve read_circle(const JsonNode& node) {
    const auto circle = read_form<form::Circle>(node);
    return Sketch::Arc{circle.end, circle.start, -1, false, false};
}

constexpr std::pair<const char*, Sketch::Curve (*)(const JsonNode&)> curves[] = {
    {"line", read_curve<Sketch::Line>},     {"arc", read_curve<Sketch::Arc>},   {"circle", read_circle},
    {"bezier", read_curve<Sketch::Bezier>}, {"nurb", read_curve<Sketch::Nurb>},
};

void read_curve(const JsonNode& node, Sketch& sketch) {
    const JsonMembers* members = node.is_object() ? &std::get<JsonMembers>(node.value()->data) : nullptr;
    for (const auto& [name, read] : curves) {
        if (members == nullptr || find_member(*members, name) == nullptr) continue;
        sketch.curves.push_back(read(node));
        const JsonNode reversed(node.file(), find_member(*members, "reversed"),
                                child_pointer(node.pointer(), "reversed"));
        if (!reversed.present()) return;
        sketch.reversed.resize(sketch.curves.size());
        sketch.reversed.back() = reversed.boolean();
        return;
    }
    node.fault(members != nullptr ? "this curve has none of the keys that name one"
                                  : std::string("expected a curve, found ") + kind_of(*node.value()),
               R"(a curve is {"line": [start, end]}, {"arc": ...}, {"circle": ...}, {"bezier": ...} or {"nurb": ...})");
}

}  // namespace

void read_value(const JsonNode& node, form::Curves, Sketch& value) {
    for (const JsonNode& item : node.items()) read_curve(item, value);
    if (!value.reversed.empty()) value.reversed.resize(value.curves.size());
}

Matrix read_placement(const JsonNode& node, const form::Placement& kind) {
    const double unit = node.file().unit;
    if (!node.present()) return usual_placement(kind, unit);
    Matrix m = read_json_matrix(node);
    for (std::size_t i = 0; i < m.size(); ++i) {
        if (is_length(kind, i)) m[i] *= unit;
    }
    return m;
}

double read_turn(const JsonObject& o, form::Turn) {
    if (o.has("radians")) {
        if (o.has("angle")) o["radians"].fault("an angle is given in degrees, or as 'radians', not both");
        return o["radians"].number();
    }
    return radians_of(o["angle"].number(360));
}

void check_value(const JsonNode& node, const form::Bounds& bounds) {
    const double* value = node.is_number() ? &std::get<double>(node.value()->data) : nullptr;
    if (value == nullptr || bounds.hold(*value)) return;
    const bool negative = *value < 0 && bounds.low == 0 && bounds.with_low;
    node.fault(negative ? form::not_negative().sentence : bounds.sentence);
}

void check_value(const JsonNode& node, form::Nonzero) {
    if (node.is_vector() && length(node.vector()) == 0) node.fault("must not be of length 0");
}

}  // namespace csgrt
