#include "formats/json/write/schema.hpp"

#include <nlohmann/json.hpp>

#include "formats/json/forms.hpp"
#include "formats/json/scene_forms.hpp"
#include "formats/json/text.hpp"

namespace csgrt {

namespace {

using nlohmann::ordered_json;

ordered_json ref(std::string_view definition) { return {{"$ref", "#/$defs/" + std::string(definition)}}; }

ordered_json list_of(ordered_json items, std::size_t least = 0, std::size_t most = SIZE_MAX) {
    ordered_json list = {{"type", "array"}, {"items", std::move(items)}};
    if (least > 0) list["minItems"] = least;
    if (most < SIZE_MAX) list["maxItems"] = most;
    return list;
}

ordered_json one_or_list_of(const ordered_json& item) { return {{"oneOf", {item, list_of(item)}}}; }

ordered_json bounded(const char* type, const form::Bounds& bounds) {
    ordered_json number = {{"type", type}};
    number[bounds.with_low ? "minimum" : "exclusiveMinimum"] = bounds.low;
    if (bounds.high != form::unlimited) number[bounds.with_high ? "maximum" : "exclusiveMaximum"] = bounds.high;
    return number;
}

// ---- Values, by their kinds ----

struct SchemaOf {
    template <class Rule>
    ordered_json operator()(form::Number, const Rule& rule) const {
        if constexpr (std::is_same_v<Rule, form::Bounds>) {
            if (rule.low == 0 && rule.high == form::unlimited) return ref(rule.with_low ? "not_negative" : "positive");
            return bounded("number", rule);
        } else {
            return {{"type", "number"}};
        }
    }
    ordered_json operator()(form::Length, const auto& rule) const { return (*this)(form::number, rule); }
    ordered_json operator()(form::Turn, const auto&) const {
        return {{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", 360}, {"default", 360}};
    }
    ordered_json operator()(form::Lengths, const auto&) const { return ref("vector"); }
    ordered_json operator()(form::Vector, const auto&) const { return ref("vector"); }
    ordered_json operator()(form::Direction, const auto&) const { return ref("vector"); }
    ordered_json operator()(form::Axis, const auto&) const { return ref("vector"); }
    ordered_json operator()(form::Color, const auto&) const { return ref("color"); }
    template <class Rule>
    ordered_json operator()(form::Count, const Rule& rule) const {
        if constexpr (std::is_same_v<Rule, form::Bounds>) {
            return bounded("integer", rule);
        } else {
            return ref("count");
        }
    }
    ordered_json operator()(form::Whole range, const auto&) const {
        return {{"type", "integer"}, {"minimum", range.low}, {"maximum", range.high}};
    }
    ordered_json operator()(form::Flag, const auto&) const { return {{"type", "boolean"}}; }
    ordered_json operator()(form::Text, const auto&) const { return {{"type", "string"}}; }
    ordered_json operator()(form::Name, const auto&) const { return ref("name"); }
    template <std::size_t count>
    ordered_json operator()(const form::Words<count>& kind, const auto&) const {
        return {{"enum", kind.words}};
    }
    ordered_json operator()(form::Triangle, const auto&) const { return list_of(ref("count"), 3, 3); }
    ordered_json operator()(form::Ends, const auto&) const { return list_of(ref("count"), 2, 2); }
    ordered_json operator()(form::Uv, const auto&) const { return list_of({{"type", "number"}}, 2, 2); }
    ordered_json operator()(form::Corners corners, const auto&) const {
        return list_of(ref("vector"), corners.count, corners.count);
    }
    ordered_json operator()(form::Loops, const auto&) const { return one_or_list_of(list_of(ref("count"), 3)); }
    ordered_json operator()(form::Curves, const auto&) const {
        return list_of({{"oneOf", {ref("line"), ref("arc"), ref("circle"), ref("bezier"), ref("nurb")}}}, 1);
    }
    ordered_json operator()(form::Cells cells, const auto&) const {
        return one_or_list_of(ref(cells.marks ? "cell_row" : "height_row"));
    }
    ordered_json operator()(form::Placement, const auto&) const { return ref("matrix"); }
    ordered_json operator()(form::Other other, const auto&) const { return ordered_json::parse(other.schema); }
    template <class S>
    ordered_json operator()(form::Object<S>, const auto&) const {
        return ref(form::of<S>.head.name);
    }
    template <class Item>
    ordered_json operator()(const form::List<Item>& list, const auto& rule) const {
        return list_of((*this)(list.item, rule), list.least, list.most);
    }
    template <class Item>
    ordered_json operator()(const form::PerFace<Item>& kind, const auto& rule) const {
        return one_or_list_of((*this)(kind.item, rule));
    }
};

/// The default of a member in JSON. Null: the member has no default.
template <std::size_t count, class Value>
ordered_json default_of(const form::Words<count>& kind, const Value& value) {
    const std::size_t i = static_cast<std::size_t>(value) - kind.first;
    return i < count ? ordered_json(kind.words.at(i)) : ordered_json();
}
template <class Kind, class Value>
ordered_json default_of(const Kind&, const Value& value) {
    if constexpr (std::is_arithmetic_v<Value> && !std::is_same_v<Kind, form::Turn>) {
        return value;
    } else if constexpr (std::is_same_v<Value, std::string>) {
        return value.empty() ? ordered_json() : ordered_json(value);
    } else {
        return {};
    }
}

// ---- Definitions ----

template <class S, class Form>
void add_form(ordered_json& definitions, const Form& form) {
    ordered_json properties = ordered_json::object(), required = ordered_json::array();
    if (form.head.has_type) {
        properties["type"] = {{"const", form.head.name}};
        required.push_back("type");
    }
    form::for_members(form, [&]<class Member>(const Member& member) {
        ordered_json property = SchemaOf{}(member.kind, member.rule);
        if constexpr (Member::given == form::Given::required) {
            required.push_back(member.key.json);
        } else if constexpr (requires(const S& s) { std::invoke(member.at, s); }) {
            const S usual = form::usual<S>();
            ordered_json otherwise = default_of(member.kind, std::invoke(member.at, usual));
            if (!otherwise.is_null()) property["default"] = std::move(otherwise);
        }
        if (*member.help != '\0') property["description"] = member.help;
        properties[std::string(member.key.json)] = std::move(property);
    });
    ordered_json definition = {{"type", "object"}};
    if (*form.head.about != '\0') definition["description"] = form.head.about;
    definition["properties"] = std::move(properties);
    if (!required.empty()) definition["required"] = std::move(required);
    definition["additionalProperties"] = false;
    definitions[form.head.name] = std::move(definition);
}
template <class... S>
void add_forms(ordered_json& definitions) {
    (add_form<S>(definitions, form::of<S>), ...);
}

void add_values(ordered_json& definitions) {
    definitions.update(ordered_json::parse(R"({
        "name": {"type": "string", "minLength": 1},
        "vector": {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3,
            "description": "x, y, z. Points and lengths are in the file's units."},
        "color": {"type": "array", "items": {"type": "number", "minimum": 0, "maximum": 1}, "minItems": 3,
            "maxItems": 3, "description": "Red, green, blue, from 0 to 1."},
        "positive": {"type": "number", "exclusiveMinimum": 0},
        "not_negative": {"type": "number", "minimum": 0},
        "count": {"type": "integer", "minimum": 0, "maximum": 4294967295},
        "matrix": {"type": "array", "items": {"type": "number"}, "minItems": 16, "maxItems": 16,
            "description": "Row by row, p' = M p; the last row is 0 0 0 1."},
        "scale": {"oneOf": [{"type": "number", "not": {"const": 0}}, {"$ref": "#/$defs/vector"}],
            "description": "One factor, or one along each axis; none of them 0."},
        "cell_row": {"type": "string", "pattern": "^[0-9 .#]*$",
            "description": "Numbers from 0 to 255 with blanks between them; '.' is 0 and '#' is 255, without blanks."},
        "height_row": {"type": "string", "pattern": "^[0-9 ]*$",
            "description": "Numbers from 0 to 65535 with blanks between them."}
    })"));
}

void add_trees(ordered_json& definitions) {
    ordered_json nodes = ordered_json::array();
    nodes.push_back(ref("name"));
    nodes.back()["description"] = "An object as it stands.";
    const auto add = [&](const auto&... node) {
        (nodes.push_back(ref(node.head.name)), ...);
        definitions["tree"] = {{"oneOf", nodes}};
        (add_form<form::Nothing>(definitions, node), ...);
    };
    add(form::leaf, form::union_, form::intersection, form::difference, form::xor_, form::not_);
    add_form<form::Nothing>(definitions, form::placed);
    add_form<form::Nothing>(definitions, form::postfix);
    add_form<form::Nothing>(definitions, form::postfix_operator);
}

void add_solids(ordered_json& definitions) {
    ordered_json solids = ordered_json::array();
    for_json_solids([&]<class S>(const S*) {
        solids.push_back(ref(form::of<S>.head.name));
        add_forms<S>(definitions);
    });
    definitions["solid"] = {{"oneOf", std::move(solids)}};
}

}  // namespace

std::string json_schema_text() {
    ordered_json definitions = ordered_json::object();
    add_forms<Scene>(definitions);
    definitions["scene"]["anyOf"] = {{{"required", {"solids"}}}, {{"required", {"combinations"}}}};
    add_values(definitions);
    add_form<Scene>(definitions, form::model_units);
    add_forms<Camera, Light, Emission, Finish, RegionColor, Density, Look, Combination, Rotation>(definitions);
    add_trees(definitions);
    add_forms<Plane, Metaball::Point, Pipe::Point, Sketch, Sketch::Line, Sketch::Arc, form::Circle, Sketch::Bezier,
              Sketch::Nurb>(definitions);
    add_solids(definitions);
    const ordered_json schema = {
        {"$schema", "https://json-schema.org/draft/2020-12/schema"},
        {"title", "csgrt scene"},
        {"description", "Solids, combined by Boolean trees. README.md beside this file describes it with examples."},
        {"$ref", "#/$defs/scene"},
        {"$defs", std::move(definitions)}};
    std::string text;
    append_json(text, schema, 0, 0);
    return text + '\n';
}

}  // namespace csgrt
