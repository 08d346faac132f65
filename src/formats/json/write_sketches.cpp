#include "formats/json/angle.hpp"
#include "formats/json/write_solid.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

using nlohmann::ordered_json;

struct CurveToJson {
    JsonUnit& unit;

    ordered_json numbers(const std::vector<double>& list) const {
        ordered_json json = ordered_json::array();
        for (const double each : list) json.push_back(unit.number(each));
        return json;
    }

    ordered_json operator()(const Sketch::Line& c) const { return {{"line", {c.start, c.end}}}; }

    ordered_json operator()(const Sketch::Arc& c) const {
        if (c.radius == -1 && !c.center_left && !c.clockwise) return {{"circle", {c.end, c.start}}};
        ordered_json json = {{"arc", {c.start, c.end}}, {"radius", unit.length(c.radius)}};
        if (c.center_left) json["center_left"] = true;
        if (c.clockwise) json["clockwise"] = true;
        return json;
    }

    ordered_json operator()(const Sketch::Bezier& c) const { return {{"bezier", c.points}}; }

    ordered_json operator()(const Sketch::Nurb& c) const {
        ordered_json json = {{"nurb", c.points}, {"order", c.order}, {"knots", numbers(c.knots)}};
        if (!c.weights.empty()) json["weights"] = numbers(c.weights);
        return json;
    }
};

ordered_json json_of_sketch(const Sketch& sketch, JsonUnit& unit) {
    ordered_json vertices = ordered_json::array(), curves = ordered_json::array();
    for (const Sketch::Point& p : sketch.vertices) vertices.push_back({unit.length(p.u), unit.length(p.v)});
    // The first curve says so even if it is not, unless the sketch says it of no curve.
    for (std::size_t i = 0; i < sketch.curves.size(); ++i) {
        ordered_json curve = std::visit(CurveToJson{unit}, sketch.curves[i]);
        const bool reversed = i < sketch.reversed.size() && sketch.reversed[i] != 0;
        if (reversed || (i == 0 && !sketch.reversed.empty())) curve["reversed"] = reversed;
        curves.push_back(std::move(curve));
    }
    ordered_json json = ordered_json::object();
    if (!sketch.name.empty()) json["name"] = sketch.name;
    json["vertices"] = std::move(vertices);
    json["curves"] = std::move(curves);
    return json;
}

}  // namespace

ordered_json SolidToJson::operator()(const Extrude& s) const {
    return {{"type", "extrude"},     {"base", unit.lengths(s.v)}, {"height", unit.lengths(s.h)},
            {"a", unit.vector(s.a)}, {"b", unit.vector(s.b)},     {"sketch", json_of_sketch(s.sketch, unit)}};
}

ordered_json SolidToJson::operator()(const Revolve& s) const {
    ordered_json json = {
        {"type", "revolve"}, {"base", unit.lengths(s.v)}, {"axis", unit.vector(s.axis)}, {"r", unit.vector(s.r)}};
    if (const auto degrees = degrees_of(unit.number(s.angle))) {
        json["angle"] = *degrees;
    } else {
        json["radians"] = s.angle;
    }
    json["sketch"] = json_of_sketch(s.sketch, unit);
    return json;
}

}  // namespace csgrt
