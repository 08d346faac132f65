#include <algorithm>

#include "formats/json/names.hpp"
#include "formats/json/write_solid.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

using nlohmann::ordered_json;

/// One number if all plates are as thick, as most are.
ordered_json json_of_thickness(const Bot& s, JsonUnit& unit) {
    const auto as_first = [&](double each) { return same_bits(each, s.thickness.front()); };
    if (s.thickness.size() == s.faces.size() && std::all_of(s.thickness.begin(), s.thickness.end(), as_first)) {
        return unit.length(s.thickness.front());
    }
    ordered_json list = ordered_json::array();
    for (const double each : s.thickness) list.push_back(unit.length(each));
    return list;
}

ordered_json json_of_append(const Bot& s) {
    const auto as_first = [&](std::uint8_t each) { return each == s.append.front(); };
    if (s.append.size() == s.faces.size() && std::all_of(s.append.begin(), s.append.end(), as_first)) {
        return s.append.front();
    }
    return s.append;
}

}  // namespace

ordered_json SolidToJson::operator()(const Bot& s) const {
    ordered_json json = {{"type", "bot"}, {"mode", json_bot_modes.at(static_cast<std::size_t>(s.mode))}};
    if (s.orientation != Bot::Orientation::unoriented) {
        json["orientation"] = json_bot_orientations.at(static_cast<std::size_t>(s.orientation));
    }
    json["vertices"] = places(s.vertices);
    json["faces"] = s.faces;
    if (!s.thickness.empty()) json["thickness"] = json_of_thickness(s, unit);
    if (!s.append.empty()) json["append"] = json_of_append(s);
    if (!s.normals.empty()) {
        ordered_json normals = ordered_json::array();
        for (const Vec3& normal : s.normals) normals.push_back(unit.vector(normal));
        json["normals"] = std::move(normals);
    }
    if (!s.face_normals.empty()) json["face_normals"] = s.face_normals;
    return json;
}

ordered_json SolidToJson::operator()(const Ars& s) const {
    ordered_json curves = ordered_json::array();
    for (const std::vector<Vec3>& curve : s.curves) curves.push_back(places(curve));
    return {{"type", "ars"}, {"curves", std::move(curves)}};
}

ordered_json SolidToJson::operator()(const Nmg& s) const {
    ordered_json faces = ordered_json::array();
    for (const std::vector<Nmg::Loop>& face : s.faces) {
        if (face.size() == 1 && !face.front().empty()) {
            faces.push_back(face.front());
        } else {
            faces.push_back(face);
        }
    }
    return {{"type", "nmg"}, {"vertices", places(s.vertices)}, {"faces", std::move(faces)}};
}

}  // namespace csgrt
