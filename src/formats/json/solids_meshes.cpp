#include "formats/json/lists.hpp"
#include "formats/json/names.hpp"
#include "formats/json/solid_readers.hpp"

namespace csgrt {

namespace {

/// A list, or one number for every face.
std::vector<double> read_thickness(const JsonNode& node, std::size_t faces) {
    std::vector<double> thickness;
    if (!node.present()) return thickness;
    if (node.is_array()) {
        thickness = read_json_numbers(node);
    } else {
        thickness.assign(faces, node.number());
    }
    for (double& each : thickness) each *= node.file().unit;
    return thickness;
}

std::vector<std::uint8_t> read_append(const JsonNode& node, std::size_t faces) {
    if (!node.present()) return {};
    if (node.is_array()) return read_json_bytes(node);
    return std::vector<std::uint8_t>(faces, static_cast<std::uint8_t>(node.integer(0, 255, 0)));
}

/// A list of loops, or a list of vertices, which is a face of one loop.
std::vector<Nmg::Loop> read_face(const JsonNode& node) {
    std::vector<Nmg::Loop> loops;
    const std::vector<JsonNode> items = node.items();
    if (!items.empty() && !items.front().is_array()) {
        loops.push_back(read_json_counts(node));
    } else {
        for (const JsonNode& loop : items) loops.push_back(read_json_counts(loop));
    }
    return loops;
}

}  // namespace

Shape read_json_bot(const JsonObject& o) {
    Bot solid;
    solid.mode = static_cast<Bot::Mode>(o["mode"].choice(json_bot_modes, static_cast<std::size_t>(solid.mode)));
    solid.orientation = static_cast<Bot::Orientation>(o["orientation"].choice(json_bot_orientations, 0));
    solid.vertices = read_json_vectors(o["vertices"], o.node().file().unit);
    solid.faces = read_json_triangles(o["faces"]);
    solid.thickness = read_thickness(o["thickness"], solid.faces.size());
    solid.append = read_append(o["append"], solid.faces.size());
    solid.normals = read_json_vectors(o["normals"], 1);
    solid.face_normals = read_json_triangles(o["face_normals"]);
    return solid;
}

Shape read_json_ars(const JsonObject& o) {
    Ars solid;
    if (!o.has("curves")) return solid;
    for (const JsonNode& curve : o["curves"].items()) {
        solid.curves.push_back(read_json_vectors(curve, curve.file().unit));
    }
    return solid;
}

Shape read_json_nmg(const JsonObject& o) {
    Nmg solid;
    solid.vertices = read_json_vectors(o["vertices"], o.node().file().unit);
    if (!o.has("faces")) return solid;
    for (const JsonNode& face : o["faces"].items()) solid.faces.push_back(read_face(face));
    return solid;
}

}  // namespace csgrt
