// Reading by form: reads the structs that form::of<S> describes.
#pragma once

#include <array>
#include <optional>
#include <type_traits>

#include "formats/json/lists.hpp"
#include "formats/json/node.hpp"
#include "form/form.hpp"
#include "scene/vector.hpp"

namespace csgrt {

template <class... Members>
constexpr auto json_keys(const form::Form<Members...>& form) {
    std::array<JsonKey, sizeof...(Members) + 1> keys{{{"type", true}}};
    std::size_t i = 1;
    form::for_members(form, [&](const auto& m) { keys[i++] = {m.key.json, m.given == form::Given::required}; });
    return keys;
}
/// The object of a form. A solid's object has the key "type" as well.
template <class Form>
JsonObject json_object(const JsonNode& node, const Form& form) {
    const auto keys = json_keys(form);
    return {node, std::span<const JsonKey>(keys).subspan(form.head.has_type ? 0 : 1)};
}

template <class S>
S read_form(const JsonNode& node);

// ---- Values, by their kinds ----

inline void read_value(const JsonNode& node, form::Number, double& value) { value = node.number(value); }
inline void read_value(const JsonNode& node, form::Length, double& value) { value = node.length(); }
inline void read_value(const JsonNode& node, form::Lengths, Vec3& value) { value = node.lengths(); }
inline void read_value(const JsonNode& node, form::Vector, Vec3& value) { value = node.vector(); }
inline void read_value(const JsonNode& node, form::Color, Vec3& value) { value = node.color(); }
inline void read_value(const JsonNode& node, form::Count, std::uint32_t& value) { value = node.count(); }
inline void read_value(const JsonNode& node, form::Flag, bool& value) { value = node.boolean(value); }
inline void read_value(const JsonNode& node, form::Text, std::string& value) { value = node.string(); }
inline void read_value(const JsonNode& node, form::Name, std::string& value) { value = node.name(); }
void read_value(const JsonNode& node, form::Axis, Vec3& value);
void read_value(const JsonNode& node, form::Direction direction, Vec3& value);
void read_value(const JsonNode& node, form::Uv, Sketch::Point& value);
void read_value(const JsonNode& node, form::Triangle, std::array<std::uint32_t, 3>& value);
void read_value(const JsonNode& node, form::Corners corners, std::span<Vec3> value);
void read_value(const JsonNode& node, form::Loops, std::vector<Nmg::Loop>& value);
void read_value(const JsonNode& node, form::Curves, Sketch& value);
void read_value(const JsonNode& node, form::Cells cells, std::vector<std::uint8_t>& value);
void read_value(const JsonNode& node, form::Cells cells, std::vector<std::uint16_t>& value);
template <class Value>
void read_value(const JsonNode& node, form::Whole range, Value& value) {
    value = static_cast<Value>(node.integer(range.low, range.high, value));
}
template <std::size_t count, class Value>
void read_value(const JsonNode& node, const form::Words<count>& kind, Value& value) {
    const std::size_t otherwise = static_cast<std::size_t>(value) - kind.first;
    value = static_cast<Value>(node.choice(kind.words, otherwise) + kind.first);
}
template <class S>
void read_value(const JsonNode& node, form::Object<S>, S& value) {
    value = read_form<S>(node);
}
template <class Item, class Value>
void read_value(const JsonNode& node, const form::List<Item>& list, std::vector<Value>& values) {
    constexpr bool is_length = std::is_same_v<Item, form::Length> || std::is_same_v<Item, form::Lengths>;
    const JsonArray* items = node.array();
    if (items != nullptr) values.reserve(items->size());
    for (std::size_t i = 0; items != nullptr && i < items->size(); ++i) {
        Value& value = values.emplace_back();
        if constexpr (requires { read_plain((*items)[i], 1, value); }) {
            if (read_plain((*items)[i], is_length ? node.file().unit : 1, value)) continue;
        }
        read_value(node.item(i), list.item, value);
    }
}
/// Reads two indices of vertices.
template <class Curve>
void read_value(const JsonNode& node, form::Ends, Curve& value) {
    std::vector<std::uint32_t> ends;
    read_value(node, form::List{form::count}, ends);
    if (ends.size() == 2) {
        value.start = ends[0];
        value.end = ends[1];
    } else if (node.is_array()) {
        node.fault("expected 2 indices of vertices, found " + std::to_string(ends.size()));
    }
}

/// Reads a list, or one value for each face.
template <class Item, class Value>
void read_per_face(const JsonNode& node, const form::PerFace<Item>& kind, std::size_t faces,
                   std::vector<Value>& values) {
    if (node.is_array()) return read_value(node, form::List{kind.item}, values);
    Value one{};
    read_value(node, kind.item, one);
    values.assign(faces, one);
}

/// Reads a placement, or returns the default, where cells have the size of the file's unit.
Matrix read_placement(const JsonNode& node, const form::Placement& kind);
/// Reads an angle in degrees, or in "radians".
double read_turn(const JsonObject& o, form::Turn);

// ---- Checks ----

inline void check_value(const JsonNode&, form::Any) {}
void check_value(const JsonNode& node, const form::Bounds& bounds);
void check_value(const JsonNode& node, form::Nonzero);

// ---- Members ----

template <class S, class Member>
void read_member(const JsonObject& o, const Member& member, S& s) {
    const JsonNode node = o[member.key.json];
    auto& value = std::invoke(member.at, s);
    if constexpr (requires { value = read_placement(node, member.kind); }) {
        value = read_placement(node, member.kind);
    } else if constexpr (requires { value = read_turn(o, member.kind); }) {
        value = read_turn(o, member.kind);
    } else if (!node.present()) {
        return;
    } else if constexpr (requires { value.emplace(); }) {
        read_value(node, member.kind, value.emplace());
    } else if constexpr (requires { read_per_face(node, member.kind, s.faces.size(), value); }) {
        read_per_face(node, member.kind, s.faces.size(), value);
    } else {
        read_value(node, member.kind, value);
    }
}

/// Reads the members that a form describes. Rules are checked here only for forms that are not the model's own structs:
/// `validate` checks those, because other readers and programs make them, too.
template <class S, class Form>
void read_members(const JsonObject& o, const Form& form, S& s) {
    form::for_members(form, [&](const auto& member) {
        if constexpr (requires { std::invoke(member.at, s); }) {
            read_member(o, member, s);
            if constexpr (requires { check_value(o.node(), member.rule); }) {
                if (!form.head.is_model) check_value(o[member.key.json], member.rule);
            }
        }
    });
}

template <class S>
S read_form(const JsonNode& node) {
    S s = form::usual<S>();
    read_members(json_object(node, form::of<S>), form::of<S>, s);
    return s;
}

}  // namespace csgrt
