#include "formats/json/write_solid.hpp"

#include "formats/json/friendly_solids.hpp"
#include "scene/vector.hpp"

namespace csgrt {

using nlohmann::ordered_json;

ordered_json SolidToJson::operator()(const Ell& s) const {
    if (s.a.x > 0 && same_bits(sphere(s.v, s.a.x), s)) {
        return {{"type", "sphere"}, {"center", unit.lengths(s.v)}, {"radius", unit.length(s.a.x)}};
    }
    return {{"type", "ell"},
            {"center", unit.lengths(s.v)},
            {"a", unit.lengths(s.a)},
            {"b", unit.lengths(s.b)},
            {"c", unit.lengths(s.c)}};
}

ordered_json SolidToJson::operator()(const Tgc& s) const {
    const double radius = length(s.a), top = length(s.c);
    const bool friendly = length(s.h) > 0 && (radius > 0 || top > 0) && same_bits(cone(s.v, s.h, radius, top), s);
    if (friendly && radius == top) {
        return {{"type", "cylinder"},
                {"base", unit.lengths(s.v)},
                {"height", unit.lengths(s.h)},
                {"radius", unit.length(radius)}};
    }
    if (friendly) {
        return {{"type", "cone"},
                {"base", unit.lengths(s.v)},
                {"height", unit.lengths(s.h)},
                {"radius", unit.length(radius)},
                {"top_radius", unit.length(top)}};
    }
    return {{"type", "tgc"},          {"base", unit.lengths(s.v)}, {"height", unit.lengths(s.h)},
            {"a", unit.lengths(s.a)}, {"b", unit.lengths(s.b)},    {"c", unit.lengths(s.c)},
            {"d", unit.lengths(s.d)}};
}

ordered_json SolidToJson::places(const std::vector<Vec3>& points) const {
    ordered_json list = ordered_json::array();
    for (const Vec3& point : points) list.push_back(unit.lengths(point));
    return list;
}

ordered_json SolidToJson::operator()(const Arb& s) const {
    const Vec3 &high = s.vertices[2], &low = s.vertices[4];
    if (low.x < high.x && low.y < high.y && low.z < high.z && same_bits(box(low, high), s)) {
        return {{"type", "box"}, {"low", unit.lengths(low)}, {"high", unit.lengths(high)}};
    }
    const std::vector<Vec3> corners = arb_vertices(s);
    return {{"type", "arb" + std::to_string(corners.size())}, {"vertices", places(corners)}};
}

ordered_json SolidToJson::plane(const Plane& plane) const {
    return {{"normal", unit.vector(plane.normal)}, {"distance", unit.length(plane.distance)}};
}

ordered_json SolidToJson::operator()(const Arbn& s) const {
    ordered_json planes = ordered_json::array();
    for (const Plane& each : s.planes) planes.push_back(plane(each));
    return {{"type", "arbn"}, {"planes", std::move(planes)}};
}

ordered_json SolidToJson::operator()(const Half& s) const {
    ordered_json half = {{"type", "half"}};
    half.update(plane(s.plane));
    return half;
}

ordered_json SolidToJson::operator()(const Tor& s) const {
    return {{"type", "tor"},
            {"center", unit.lengths(s.v)},
            {"axis", unit.vector(s.h)},
            {"radius", unit.length(s.r_a)},
            {"tube", unit.length(s.r_h)}};
}

ordered_json SolidToJson::operator()(const Ehy& s) const {
    return {{"type", "ehy"},         {"base", unit.lengths(s.v)}, {"height", unit.lengths(s.h)},
            {"a", unit.vector(s.a)}, {"r1", unit.length(s.r_1)},  {"r2", unit.length(s.r_2)},
            {"c", unit.length(s.c)}};
}

ordered_json SolidToJson::operator()(const Unsupported& s) const { return {{"type", "unsupported"}, {"was", s.type}}; }

ordered_json json_of(const Shape& shape, JsonUnit& unit) { return std::visit(SolidToJson{unit}, shape); }

}  // namespace csgrt
