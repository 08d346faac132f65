// Writing by form: writes the structs that form::of<S> describes.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "formats/json/write/unit.hpp"
#include "form/form.hpp"
#include "scene/vector.hpp"

namespace csgrt {

// Values are constructed as objects or arrays: a null that becomes an object by written[key] would be left broken if
// memory runs out.

template <class S>
nlohmann::ordered_json write_form(const S& s, JsonUnit& unit);

// ---- Values, by their kinds ----

template <class Kind, class Value>
nlohmann::ordered_json write_value(const Kind&, const Value& value, JsonUnit& unit) {
    if constexpr (std::is_same_v<Value, double>) {
        return unit.number(value);
    } else if constexpr (std::is_same_v<Value, Vec3>) {
        return unit.vector(value);
    } else {
        return value;
    }
}
inline nlohmann::ordered_json write_value(form::Length, double value, JsonUnit& unit) { return unit.length(value); }
inline nlohmann::ordered_json write_value(form::Lengths, const Vec3& value, JsonUnit& unit) {
    return unit.lengths(value);
}
inline nlohmann::ordered_json write_value(form::Uv, const Sketch::Point& value, JsonUnit& unit) {
    return {unit.length(value.u), unit.length(value.v)};
}
template <std::size_t count, class Value>
nlohmann::ordered_json write_value(const form::Words<count>& kind, Value value, JsonUnit&) {
    return kind.words.at(static_cast<std::size_t>(value) - kind.first);
}
template <class Curve>
nlohmann::ordered_json write_value(form::Ends, const Curve& value, JsonUnit&) {
    return {value.start, value.end};
}
template <class S>
nlohmann::ordered_json write_value(form::Object<S>, const S& value, JsonUnit& unit) {
    return write_form(value, unit);
}
template <class Item, class Value>
nlohmann::ordered_json write_value(const form::List<Item>& list, const std::vector<Value>& values, JsonUnit& unit) {
    nlohmann::ordered_json written = nlohmann::ordered_json::array();
    for (const Value& value : values) written.push_back(write_value(list.item, value, unit));
    return written;
}
nlohmann::ordered_json write_value(form::Corners, const auto& vertices, JsonUnit& unit) {
    return write_value(form::List{form::lengths}, std::vector<Vec3>(vertices.begin(), vertices.end()), unit);
}
/// Writes a face. A face of one loop is written as the loop itself.
nlohmann::ordered_json write_value(form::Loops, const std::vector<Nmg::Loop>& face, JsonUnit& unit);
/// Writes curves. If the sketch has flags for reversed curves, the first curve always has the key "reversed".
nlohmann::ordered_json write_value(form::Curves, const Sketch& sketch, JsonUnit& unit);

/// Whether two values are written alike.
template <class Value>
bool same_value(const Value& a, const Value& b) {
    if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, Vec3>) {
        return same_bits(a, b);
    } else {
        return a == b;
    }
}

/// Writes a single value if it is the same for all faces, as in most meshes.
template <class Item, class Value>
nlohmann::ordered_json write_per_face(const form::PerFace<Item>& kind, const std::vector<Value>& values,
                                      std::size_t faces, JsonUnit& unit) {
    const auto as_first = [&](const Value& each) { return same_value(each, values.front()); };
    if (values.size() == faces && std::all_of(values.begin(), values.end(), as_first))
        return write_value(kind.item, values.front(), unit);
    return write_value(form::List{kind.item}, values, unit);
}

/// Writes a string for each row of `width` cells. If marks are allowed and all cells are 0 or `most`, the rows consist
/// of '.' and '#'.
template <class Cell>
nlohmann::ordered_json write_cells(form::Cells kind, const std::vector<Cell>& cells, std::size_t width) {
    const bool picture =
        kind.marks && std::all_of(cells.begin(), cells.end(), [&](Cell c) { return c == 0 || c == kind.most; });
    if (width == 0 || width > cells.size()) width = std::max<std::size_t>(cells.size(), 1);
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (std::size_t begin = 0; begin < cells.size();) {
        std::string row;
        for (const std::size_t end = begin + std::min(width, cells.size() - begin); begin < end; ++begin) {
            if (picture) {
                row += cells[begin] == 0 ? '.' : '#';
            } else {
                row += (row.empty() ? "" : " ") + std::to_string(cells[begin]);
            }
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

/// Writes the placement as "matrix", except if it is the default.
void write_placement(nlohmann::ordered_json& out, const form::Placement& kind, const Matrix& m, JsonUnit& unit);
/// Writes the angle as "angle" in degrees, or as "radians".
void write_turn(nlohmann::ordered_json& out, form::Turn, double angle, JsonUnit& unit);

// ---- Members ----

template <class S, class Value, class At>
bool is_usual(const S&, const Value& value, const At& at) {
    if constexpr (requires { value.empty(); }) {
        return value.empty();
    } else {
        static const S& usual = *new const S(form::usual<S>());  // never destroyed: threads may outlive exit()
        return same_value(value, std::invoke(at, usual));
    }
}

template <class S, class Member>
void write_member(nlohmann::ordered_json& out, const Member& member, const S& s, JsonUnit& unit) {
    const auto& value = std::invoke(member.at, s);
    const std::string key(member.key.json);
    if constexpr (requires { value.has_value(); }) {
        if (value) out[key] = write_value(member.kind, *value, unit);
    } else if constexpr (requires { write_placement(out, member.kind, value, unit); }) {
        write_placement(out, member.kind, value, unit);
    } else if constexpr (requires { write_turn(out, member.kind, value, unit); }) {
        write_turn(out, member.kind, value, unit);
    } else {
        if constexpr (Member::given == form::Given::optional) {
            if (is_usual(s, value, member.at)) return;
        }
        if constexpr (requires { write_cells(member.kind, value, s.width); }) {
            out[key] = write_cells(member.kind, value, s.width);
        } else if constexpr (requires { write_per_face(member.kind, value, s.faces.size(), unit); }) {
            out[key] = write_per_face(member.kind, value, s.faces.size(), unit);
        } else {
            out[key] = write_value(member.kind, value, unit);
        }
    }
}

template <class S, class Form>
void write_members(nlohmann::ordered_json& out, const Form& form, const S& s, JsonUnit& unit) {
    form::for_members(form, [&](const auto& member) {
        if constexpr (requires { std::invoke(member.at, s); }) write_member(out, member, s, unit);
    });
}

template <class S>
nlohmann::ordered_json write_form(const S& s, JsonUnit& unit) {
    nlohmann::ordered_json out = nlohmann::ordered_json::object();
    if (form::of<S>.head.has_type) out["type"] = form::of<S>.head.name;
    write_members(out, form::of<S>, s, unit);
    return out;
}

}  // namespace csgrt
