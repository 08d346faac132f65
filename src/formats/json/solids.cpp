#include "formats/json/solids.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "formats/json/friendly_solids.hpp"
#include "formats/json/solid_readers.hpp"
#include "scene/nearest.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

Vec3 nonzero(const JsonNode& node, Vec3 v) {
    if (node.is_vector() && length(v) == 0) node.fault("must not be of length 0");
    return v;
}

/// May be 0 at one end of a cone, not at both.
double radius_of_cone(const JsonNode& node) { return node.file().unit * node.not_negative(0); }

Shape read_sphere(const JsonObject& o) { return sphere(o["center"].lengths(), o["radius"].positive_length()); }

Shape read_ell(const JsonObject& o) {
    return Ell{o["center"].lengths(), o["a"].lengths(), o["b"].lengths(), o["c"].lengths()};
}

Shape read_cylinder(const JsonObject& o) {
    const double radius = o["radius"].positive_length();
    return cone(o["base"].lengths(), nonzero(o["height"], o["height"].lengths()), radius, radius);
}

Shape read_cone(const JsonObject& o) {
    const double radius = radius_of_cone(o["radius"]), top = radius_of_cone(o["top_radius"]);
    if (o["radius"].present() && radius == 0 && top == 0) {
        o["radius"].fault("'radius' and 'top_radius' must not both be 0");
    }
    return cone(o["base"].lengths(), nonzero(o["height"], o["height"].lengths()), radius, top);
}

Shape read_tgc(const JsonObject& o) {
    return Tgc{o["base"].lengths(), o["height"].lengths(), o["a"].lengths(),
               o["b"].lengths(),    o["c"].lengths(),      o["d"].lengths()};
}

Shape read_box(const JsonObject& o) {
    const Vec3 low = o["low"].lengths(), high = o["high"].lengths();
    if (o["low"].is_vector() && o["high"].is_vector() && !(low.x < high.x && low.y < high.y && low.z < high.z)) {
        o["high"].fault("each number of 'high' must be greater than that of 'low'");
    }
    return box(low, high);
}

Shape read_arb(const JsonObject& o, std::size_t count) {
    const std::vector<JsonNode> items = o["vertices"].items();
    if (o["vertices"].is_array() && items.size() != count) {
        o["vertices"].fault("expected " + std::to_string(count) + " vertices, found " + std::to_string(items.size()),
                            items.size() >= 4 && items.size() <= 8
                                ? "the type 'arb" + std::to_string(items.size()) + "' has that many"
                                : "");
    }
    std::vector<Vec3> vertices;
    for (const JsonNode& item : items) vertices.push_back(item.lengths());
    vertices.resize(count);
    return arb(vertices);
}

Plane read_plane(const JsonObject& o) {
    return {nonzero(o["normal"], o["normal"].direction()), o["distance"].length()};
}

Shape read_arbn(const JsonObject& o) {
    Arbn solid;
    for (const JsonNode& item : o["planes"].items()) solid.planes.push_back(read_plane({item, json_form("plane")}));
    return solid;
}

Shape read_half(const JsonObject& o) { return Half{read_plane(o)}; }

Shape read_tor(const JsonObject& o) {
    return Tor{o["center"].lengths(), o["axis"].vector(), o["radius"].length(), o["tube"].length()};
}

Shape read_ehy(const JsonObject& o) {
    return Ehy{o["base"].lengths(), o["height"].lengths(), o["a"].direction(),
               o["r1"].length(),    o["r2"].length(),      o["c"].length()};
}

Shape read_unsupported(const JsonObject& o) { return Unsupported{o["was"].name()}; }

using Read = Shape (*)(const JsonObject&);
constexpr std::pair<std::string_view, Read> readers[] = {
    {"sphere", read_sphere},
    {"ell", read_ell},
    {"cylinder", read_cylinder},
    {"cone", read_cone},
    {"tgc", read_tgc},
    {"box", read_box},
    {"arb4", [](const JsonObject& o) { return read_arb(o, 4); }},
    {"arb5", [](const JsonObject& o) { return read_arb(o, 5); }},
    {"arb6", [](const JsonObject& o) { return read_arb(o, 6); }},
    {"arb7", [](const JsonObject& o) { return read_arb(o, 7); }},
    {"arb8", [](const JsonObject& o) { return read_arb(o, 8); }},
    {"arbn", read_arbn},
    {"half", read_half},
    {"tor", read_tor},
    {"ehy", read_ehy},
    {"part", read_json_part},
    {"epa", read_json_epa},
    {"rpc", read_json_rpc},
    {"rhc", read_json_rhc},
    {"eto", read_json_eto},
    {"hyp", read_json_hyp},
    {"superell", read_json_superell},
    {"hrt", read_json_hrt},
    {"metaball", read_json_metaball},
    {"pipe", read_json_pipe},
    {"cline", read_json_cline},
    {"bot", read_json_bot},
    {"ars", read_json_ars},
    {"nmg", read_json_nmg},
    {"ebm", read_json_ebm},
    {"vol", read_json_vol},
    {"dsp", read_json_dsp},
    {"extrude", read_json_extrude},
    {"revolve", read_json_revolve},
    {"unsupported", read_unsupported},
};

/// What an object without a type can be told.
std::string all_types() {
    std::string list;
    for (const std::string_view type : json_solid_types())
        list += (list.empty() ? "one of " : ", ") + std::string(type);
    return list;
}

}  // namespace

Shape read_json_solid(const JsonNode& node) {
    const JsonMembers* members = node.is_object() ? std::get_if<JsonMembers>(&node.value()->data) : nullptr;
    if (members == nullptr) {
        node.fault(std::string("expected a solid, {\"type\": ...}, found ") + kind_of(*node.value()));
        return Unsupported{};
    }
    const JsonNode type(node.file(), find_member(*members, "type"), child_pointer(node.pointer(), "type"));
    if (!type.present()) {
        node.fault("the key 'type' is missing", all_types());
        return Unsupported{};
    }
    const std::string name = type.string();
    const auto reader =
        std::find_if(std::begin(readers), std::end(readers), [&](const auto& it) { return it.first == name; });
    if (reader != std::end(readers)) return reader->second(JsonObject(node, json_form(name)));
    if (type.is_string()) {
        const std::string nearest = did_you_mean(name, json_solid_types());
        type.fault("there is no solid of type '" + name + "'", nearest.empty() ? all_types() : nearest);
    }
    return Unsupported{};
}

}  // namespace csgrt
