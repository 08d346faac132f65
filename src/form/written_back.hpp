// Writes the command that draws a picture again, for pictures, the page and Python. Most options follow from the
// descriptions. Options that set two members, and members that several options set, have code here.
#pragma once

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <csgrt/check.hpp>

#include "base/decimal.hpp"
#include "base/shell_word.hpp"
#include "form/requests.hpp"

namespace csgrt {

inline std::string shortest(const Vec3& v) { return shortest(v.x) + "," + shortest(v.y) + "," + shortest(v.z); }

/// One member's option, for example " --samples 4". Empty if the value is `usual`.
template <class Member, class Value>
std::string option_text(const Member& member, const Value& value, const std::optional<Value>& usual = {}) {
    const std::string name = std::string(" ") + member.option.name;
    if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
        std::string text;
        for (const std::string& one : value) text += name + " " + shell_word(one);
        return text;
    } else if constexpr (std::is_same_v<Value, std::vector<Plane>>) {
        std::string text;
        for (const Plane& plane : value) text += name + " " + shortest(plane.normal) + ":" + shortest(plane.distance);
        return text;
    } else {
        if (usual && *usual == value) return {};
        if constexpr (std::is_same_v<Value, bool>) {
            return value == !member.option.is_off ? name : std::string();
        } else if constexpr (std::is_same_v<Value, std::string>) {
            return name + " " + shell_word(value);
        } else if constexpr (std::is_enum_v<Value>) {
            return name + " " + std::string(name_of(*member.kind.names, value));
        } else if constexpr (std::is_integral_v<Value>) {
            return name + " " + std::to_string(value);
        } else {
            return name + " " + shortest(value);
        }
    }
}

/// The options for members that change answers and do not have their defaults.
template <class S>
std::string options_text(const S& given) {
    const S usual{};
    std::string text;
    form::for_members(form::of<S>, [&](const auto& member) {
        if constexpr (std::is_member_object_pointer_v<decltype(member.at)>) {
            using Value = std::remove_cvref_t<decltype(given.*member.at)>;
            if constexpr (!std::is_same_v<Value, Camera> &&
                          !std::is_same_v<std::remove_cvref_t<decltype(member.kind)>, form::Special>) {
                if (*member.option.name && member.option.changes_answers)
                    text += option_text(member, given.*member.at, std::optional<Value>(usual.*member.at));
            }
        }
    });
    return text;
}

/// The options for all members of a camera, because the scene may have another camera. With an eye, the angles are left
/// out.
inline std::string options_text(const Camera& camera) {
    std::string text;
    form::for_members(form::of<Camera>, [&](const auto& member) {
        const auto& value = camera.*member.at;
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, double>) {
            const bool is_angle_of_eye = &value != &camera.perspective;
            if (!(camera.eye && is_angle_of_eye)) text += option_text(member, value);
        } else if (value) {
            text += option_text(member, *value);
        }
    });
    return text;
}

inline std::string options_text(const std::vector<Look>& looks) {
    std::string text;
    for (const Look& look : looks) {
        if (look.state) text += (*look.state == State::shown ? " --show " : " --hide ") + shell_word(look.path);
        if (look.color) text += " --color " + shell_word(look.path + ":" + shortest(*look.color));
    }
    return text;
}

/// The option for a tolerance in millimetres, or without `tolerance` for the settings' own.
inline std::string tolerance_text(const Settings& settings, std::optional<double> tolerance = {}) {
    if (tolerance) return " --tolerance " + shortest(*tolerance);
    if (settings.tolerance_rule != Tolerance::length)
        return " --tolerance " + std::string(name_of(tolerance_names, settings.tolerance_rule));
    return settings.tolerance >= 0 ? " --tolerance " + shortest(settings.tolerance) : std::string();
}

/// The words after `csgrt` that load a model: a file, its objects, and options.
inline std::string model_words(const std::string& scene, const std::vector<std::string>& objects,
                               const LoadOptions& load, const Settings& settings,
                               std::optional<double> tolerance = {}) {
    std::string text = shell_word(scene);
    for (const std::string& object : objects) text += " " + shell_word(object);
    return text + options_text(load) + options_text(settings) + tolerance_text(settings, tolerance);
}

/// The options that draw a view.
inline std::string drawing_options(const View& view, const std::vector<Look>& looks) {
    return " --size " + std::to_string(view.width) + "x" + std::to_string(view.height) + options_text(view.camera) +
           options_text(view) + options_text(looks);
}

/// What follows the address of `csgrt view` in a link to an overlap, which src/view/page/link.mjs reads. All other
/// regions are ghosts.
inline std::string link_of(const FoundOverlap& overlap, const Model& model) {
    const auto coded = [](const char* form, char c) {
        char text[8];
        std::snprintf(text, sizeof text, form, static_cast<unsigned>(static_cast<unsigned char>(c)));
        return std::string(text);
    };
    std::string looks = R"({"path":"/","state":"ghost"})", selected, link = "#";
    for (const std::uint32_t region : overlap.regions) {
        std::string path;
        for (const char c : model.regions()[region].path)
            path += c == '"' || c == '\\' || (c >= 0 && c < ' ') ? coded("\\u%04x", c) : std::string(1, c);
        looks += R"(,{"path":")" + path + R"(","state":"shown"})";
        selected += (selected.empty() ? "\"" : ",\"") + path + "\"";
    }
    const auto& [low, high] = overlap.box;
    const double size = 3 * std::hypot(high.x - low.x, high.y - low.y, high.z - low.z);
    const std::string view = R"({"camera":{"center":[)" + shortest(overlap.place) + R"(],"view_size":)" +
                             shortest(size) + R"(},"show":"overlap","looks":[)" + looks + R"(],"selected":[)" +
                             selected + "]}";
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./";
    for (const char c : view) link += plain.find(c) != plain.npos ? std::string(1, c) : coded("%%%02X", c);
    return link;
}

}  // namespace csgrt
