#include "formats/json/names.hpp"
#include "formats/json/write_solid.hpp"
#include "scene/vector.hpp"

namespace csgrt {

using nlohmann::ordered_json;

ordered_json SolidToJson::operator()(const Part& s) const {
    return {{"type", "part"},
            {"base", unit.lengths(s.v)},
            {"height", unit.lengths(s.h)},
            {"radius", unit.length(s.r_v)},
            {"top_radius", unit.length(s.r_h)}};
}

ordered_json SolidToJson::operator()(const Epa& s) const {
    return {{"type", "epa"},         {"base", unit.lengths(s.v)}, {"height", unit.lengths(s.h)},
            {"a", unit.vector(s.a)}, {"r1", unit.length(s.r_1)},  {"r2", unit.length(s.r_2)}};
}

ordered_json SolidToJson::operator()(const Rpc& s) const {
    return {{"type", "rpc"},
            {"base", unit.lengths(s.v)},
            {"height", unit.lengths(s.h)},
            {"b", unit.lengths(s.b)},
            {"half_width", unit.length(s.r)}};
}

ordered_json SolidToJson::operator()(const Rhc& s) const {
    return {{"type", "rhc"},          {"base", unit.lengths(s.v)},      {"height", unit.lengths(s.h)},
            {"b", unit.lengths(s.b)}, {"half_width", unit.length(s.r)}, {"c", unit.length(s.c)}};
}

ordered_json SolidToJson::operator()(const Eto& s) const {
    return {{"type", "eto"},
            {"center", unit.lengths(s.v)},
            {"axis", unit.vector(s.n)},
            {"radius", unit.length(s.r)},
            {"c", unit.lengths(s.c)},
            {"d", unit.length(s.r_d)}};
}

ordered_json SolidToJson::operator()(const Hyp& s) const {
    return {{"type", "hyp"},          {"base", unit.lengths(s.v)}, {"height", unit.lengths(s.h)},
            {"a", unit.lengths(s.a)}, {"b", unit.length(s.b)},     {"neck", unit.number(s.neck)}};
}

ordered_json SolidToJson::operator()(const Superell& s) const {
    return {{"type", "superell"},     {"center", unit.lengths(s.v)}, {"a", unit.lengths(s.a)}, {"b", unit.lengths(s.b)},
            {"c", unit.lengths(s.c)}, {"n", unit.number(s.n)},       {"e", unit.number(s.e)}};
}

ordered_json SolidToJson::operator()(const Hrt& s) const {
    ordered_json json = {{"type", "hrt"},
                         {"center", unit.lengths(s.v)},
                         {"x", unit.lengths(s.x)},
                         {"y", unit.lengths(s.y)},
                         {"z", unit.lengths(s.z)}};
    if (!same_bits(s.d, 0.0)) json["d"] = unit.length(s.d);
    return json;
}

ordered_json SolidToJson::operator()(const Metaball& s) const {
    ordered_json points = ordered_json::array();
    for (const Metaball::Point& p : s.points) {
        ordered_json point = {{"position", unit.lengths(p.position)}, {"strength", unit.length(p.strength)}};
        if (!same_bits(p.softness, 1.0)) point["softness"] = unit.number(p.softness);
        points.push_back(std::move(point));
    }
    return {{"type", "metaball"},
            {"method", json_metaball_methods.at(static_cast<std::size_t>(s.method))},
            {"threshold", unit.number(s.threshold)},
            {"points", std::move(points)}};
}

ordered_json SolidToJson::operator()(const Pipe& s) const {
    ordered_json points = ordered_json::array();
    for (const Pipe::Point& p : s.points) {
        ordered_json point = {{"position", unit.lengths(p.position)}, {"outer", unit.length(p.outer)}};
        if (!same_bits(p.inner, 0.0)) point["inner"] = unit.length(p.inner);
        if (!same_bits(p.bend, 0.0)) point["bend"] = unit.length(p.bend);
        points.push_back(std::move(point));
    }
    return {{"type", "pipe"}, {"points", std::move(points)}};
}

ordered_json SolidToJson::operator()(const Cline& s) const {
    ordered_json json = {{"type", "cline"},
                         {"base", unit.lengths(s.v)},
                         {"height", unit.lengths(s.h)},
                         {"radius", unit.length(s.radius)}};
    if (!same_bits(s.thickness, 0.0)) json["thickness"] = unit.length(s.thickness);
    return json;
}

}  // namespace csgrt
