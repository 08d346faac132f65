#include "formats/json/forms.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace csgrt {

namespace {

constexpr bool required = true;

/// A tree's node: what it is, and what places it.
JsonForm node(std::string_view name, std::string_view key) {
    return {name, {{key, required}, {"matrix"}, {"translate"}, {"rotate"}, {"scale"}}};
}

JsonForm solid(std::string_view name, std::vector<JsonKey> keys) {
    keys.insert(keys.begin(), {"type", required});
    return {name, std::move(keys)};
}

std::vector<JsonForm> solid_forms() {
    return {
        solid("sphere", {{"center", required}, {"radius", required}}),
        solid("ell", {{"center", required}, {"a", required}, {"b", required}, {"c", required}}),
        solid("cylinder", {{"base", required}, {"height", required}, {"radius", required}}),
        solid("cone", {{"base", required}, {"height", required}, {"radius", required}, {"top_radius"}}),
        solid("tgc", {{"base", required},
                      {"height", required},
                      {"a", required},
                      {"b", required},
                      {"c", required},
                      {"d", required}}),
        solid("box", {{"low", required}, {"high", required}}),
        solid("arb4", {{"vertices", required}}),
        solid("arb5", {{"vertices", required}}),
        solid("arb6", {{"vertices", required}}),
        solid("arb7", {{"vertices", required}}),
        solid("arb8", {{"vertices", required}}),
        solid("arbn", {{"planes", required}}),
        solid("half", {{"normal", required}, {"distance", required}}),
        solid("tor", {{"center", required}, {"axis", required}, {"radius", required}, {"tube", required}}),
        solid("ehy", {{"base", required},
                      {"height", required},
                      {"a", required},
                      {"r1", required},
                      {"r2", required},
                      {"c", required}}),
        solid("part", {{"base", required}, {"height", required}, {"radius", required}, {"top_radius", required}}),
        solid("epa", {{"base", required}, {"height", required}, {"a", required}, {"r1", required}, {"r2", required}}),
        solid("rpc", {{"base", required}, {"height", required}, {"b", required}, {"half_width", required}}),
        solid("rhc",
              {{"base", required}, {"height", required}, {"b", required}, {"half_width", required}, {"c", required}}),
        solid("eto",
              {{"center", required}, {"axis", required}, {"radius", required}, {"c", required}, {"d", required}}),
        solid("hyp", {{"base", required}, {"height", required}, {"a", required}, {"b", required}, {"neck", required}}),
        solid("superell", {{"center", required}, {"a", required}, {"b", required}, {"c", required}, {"n"}, {"e"}}),
        solid("hrt", {{"center", required}, {"x", required}, {"y", required}, {"z", required}, {"d"}}),
        solid("metaball", {{"method"}, {"threshold"}, {"points", required}}),
        solid("pipe", {{"points", required}}),
        solid("cline", {{"base", required}, {"height", required}, {"radius", required}, {"thickness"}}),
        solid("bot", {{"vertices", required},
                      {"faces", required},
                      {"mode"},
                      {"orientation"},
                      {"thickness"},
                      {"append"},
                      {"normals"},
                      {"face_normals"}}),
        solid("ars", {{"curves", required}}),
        solid("nmg", {{"vertices", required}, {"faces", required}}),
        solid("ebm", {{"width", required},
                      {"depth", required},
                      {"height", required},
                      {"cells", required},
                      {"matrix"},
                      {"file"}}),
        solid("vol", {{"width", required},
                      {"depth", required},
                      {"height", required},
                      {"cell", required},
                      {"low", required},
                      {"high"},
                      {"cells", required},
                      {"matrix"},
                      {"file"}}),
        solid("dsp", {{"width", required},
                      {"depth", required},
                      {"heights", required},
                      {"matrix"},
                      {"smooth"},
                      {"cut"},
                      {"file"}}),
        solid("extrude", {{"base", required}, {"height", required}, {"a"}, {"b"}, {"sketch", required}}),
        solid("revolve",
              {{"base", required}, {"axis", required}, {"r", required}, {"angle"}, {"radians"}, {"sketch", required}}),
        solid("unsupported", {{"was", required}}),
    };
}

std::vector<JsonForm> all_forms() {
    std::vector<JsonForm> forms = {
        {"scene",
         {{"csgrt", required},
          {"$schema"},
          {"title"},
          {"units"},
          {"model_units"},
          {"camera"},
          {"lights"},
          {"ambient"},
          {"background"},
          {"tolerance"},
          {"materials"},
          {"solids"},
          {"combinations"},
          {"objects"},
          {"order"},
          {"region_colors"}}},
        {"model_units", {{"name", required}, {"millimetres", required}}},
        {"camera", {{"azimuth"}, {"elevation"}, {"perspective"}, {"center"}, {"size"}, {"eye"}, {"look_at"}, {"up"}}},
        {"light", {{"position", required}, {"color"}, {"intensity"}, {"infinite"}, {"angle"}, {"direction"}}},
        {"material",
         {{"color"},
          {"shader"},
          {"specular"},
          {"diffuse"},
          {"ambient"},
          {"shine"},
          {"transmit"},
          {"reflect"},
          {"light"}}},
        {"emission",
         {{"intensity"}, {"fraction"}, {"angle"}, {"target"}, {"direction"}, {"infinite"}, {"visible"}, {"shadows"}}},
        {"region_color", {{"low", required}, {"high", required}, {"color", required}}},
        {"combination",
         {{"tree", required},
          {"region"},
          {"id"},
          {"air"},
          {"fastgen"},
          {"material_id"},
          {"los"},
          {"material"},
          {"inherit"}}},
        node("leaf", "object"),
        node("union", "union"),
        node("intersection", "intersection"),
        node("difference", "difference"),
        node("xor", "xor"),
        node("not", "not"),
        {"postfix", {{"postfix", required}}},
        {"postfix_operator", {{"operator", required}, {"operands", required}}},
        {"rotation", {{"axis", required}, {"angle", required}}},
        {"plane", {{"normal", required}, {"distance", required}}},
        {"metaball_point", {{"position", required}, {"strength", required}, {"softness"}}},
        {"pipe_point", {{"position", required}, {"outer", required}, {"inner"}, {"bend"}}},
        {"sketch", {{"vertices", required}, {"curves", required}, {"name"}}},
        {"line", {{"line", required}, {"reversed"}}},
        {"arc", {{"arc", required}, {"radius", required}, {"center_left"}, {"clockwise"}, {"reversed"}}},
        {"circle", {{"circle", required}, {"reversed"}}},
        {"bezier", {{"bezier", required}, {"reversed"}}},
        {"nurb", {{"nurb", required}, {"order", required}, {"knots", required}, {"weights"}, {"reversed"}}},
    };
    for (JsonForm& form : solid_forms()) forms.push_back(std::move(form));
    return forms;
}

}  // namespace

const std::vector<JsonForm>& json_forms() {
    static const auto& forms = *new const std::vector<JsonForm>(all_forms());  // for threads that see exit(), too
    return forms;
}

const JsonForm& json_form(std::string_view name) {
    const auto& forms = json_forms();
    const auto found =
        std::find_if(forms.begin(), forms.end(), [&](const JsonForm& form) { return form.name == name; });
    if (found == forms.end()) throw std::logic_error("no JSON form is called " + std::string(name));
    return *found;
}

const std::vector<std::string_view>& json_solid_types() {
    static const auto& types = *new const std::vector<std::string_view>([] {
        std::vector<std::string_view> names;
        for (const JsonForm& form : solid_forms()) names.push_back(form.name);
        return names;
    }());
    return types;
}

const std::vector<std::string_view>& json_units() {
    static const auto& units =
        *new const std::vector<std::string_view>{"nm", "um", "mm", "cm", "m", "km", "in", "ft", "yd", "mi"};
    return units;
}

}  // namespace csgrt
