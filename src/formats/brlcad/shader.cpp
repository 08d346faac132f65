#include "formats/brlcad/shader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "base/decimal.hpp"
#include "formats/brlcad/values.hpp"

namespace csgrt {

namespace {

/// The largest exponent of a highlight: beyond it the highlight is only a point.
constexpr double max_shine = 10'000;

/// The next token of a parameter list. Blanks, braces, quotes and '=' separate tokens.
std::string_view next_token(std::string_view& text) {
    constexpr std::string_view separators = " \t\r\n={}\"";
    const std::size_t begin = std::min(text.find_first_not_of(separators), text.size());
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    const std::string_view token = text.substr(begin, end - begin);
    text.remove_prefix(end);
    return token;
}

/// The text without the blanks around it.
std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n";
    const std::size_t begin = std::min(text.find_first_not_of(blanks), text.size());
    const std::size_t end = text.find_last_not_of(blanks);
    return text.substr(begin, end == std::string_view::npos ? 0 : end + 1 - begin);
}

/// The length of the braced group that `text` starts with. If the brace is not closed, the length of `text`.
std::size_t group_length(std::string_view text) {
    std::size_t depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '{') ++depth;
        if (text[i] == '}' && --depth == 0) return i + 1;
    }
    return text.size();
}

/// The text without pairs of braces around all of it, at most `deepest` pairs.
std::string_view unwrapped(std::string_view text) {
    constexpr int deepest = 8;
    text = trimmed(text);
    for (int depth = 0; depth < deepest; ++depth) {
        if (text.size() < 2 || text.front() != '{' || group_length(text) != text.size() || text.back() != '}') break;
        text = trimmed(text.substr(1, text.size() - 2));
    }
    return text;
}

/// The next shader of a stack. In the older notation a ';' ends it, in the newer one it is a braced group.
std::string_view next_member(std::string_view& stack) {
    stack.remove_prefix(std::min(stack.find_first_not_of(" \t\r\n;"), stack.size()));
    const bool braced = !stack.empty() && stack.front() == '{';
    const std::size_t length = braced ? group_length(stack) : std::min(stack.find(';'), stack.size());
    const std::string_view member = stack.substr(0, length);
    stack.remove_prefix(length);
    return unwrapped(member);
}

/// The four shaders of BRL-CAD's Phong model, with the defaults of its liboptical; nullopt for all others.
std::optional<Finish> phong_family(std::string_view shader) {
    Finish finish;
    if (shader == "plastic" || shader == "phong" || shader == "default") return finish;
    finish.shine = 4;
    if (shader == "mirror") {
        finish.specular = 0.6;
        finish.diffuse = 0.4;
        finish.reflect = 0.75;
        return finish;
    }
    if (shader == "glass") {
        finish.transmit = 0.8;
        finish.reflect = 0.1;
        return finish;
    }
    return std::nullopt;
}

void set_parameter(Finish& finish, std::string_view key, double value) {
    if (key == "sh" || key == "shine") {
        finish.shine = static_cast<int>(std::clamp(value, 0.0, max_shine));
    } else if (key == "sp" || key == "specular") {
        finish.specular = value;
    } else if (key == "di" || key == "diffuse") {
        finish.diffuse = value;
    } else if (key == "tr" || key == "transmit") {
        finish.transmit = value;
    } else if (key == "re" || key == "reflect") {
        finish.reflect = value;
    }
}

void set_parameters(Finish& finish, std::string_view parameters) {
    while (true) {
        const std::string_view key = next_token(parameters);
        if (key.empty()) return;
        // If the next token is not a number, it is the next key.
        std::string_view rest = parameters;
        if (const auto value = finite_decimal(next_token(rest))) {
            set_parameter(finish, key, *value);
            parameters = rest;
        }
    }
}

/// Takes the next `count` numbers. If there are fewer, returns nothing and leaves `parameters` unchanged.
template <std::size_t count>
std::optional<std::array<double, count>> next_numbers(std::string_view& parameters) {
    std::string_view rest = parameters;
    std::array<double, count> numbers{};
    for (double& x : numbers) {
        // A vector may have commas in it, as in "1,0,0".
        const std::size_t begin = std::min(rest.find_first_not_of(" \t\r\n={}\","), rest.size());
        const std::size_t end = std::min(rest.find_first_of(" \t\r\n={}\",", begin), rest.size());
        const auto value = finite_decimal(rest.substr(begin, end - begin));
        if (!value) return std::nullopt;
        x = *value;
        rest.remove_prefix(end);
    }
    parameters = rest;
    return numbers;
}

/// Is a flag set? BRL-CAD reads the flag as a whole number, so 0.5 is not set.
bool is_set(double flag) { return static_cast<int>(std::clamp(flag, -1e9, 1e9)) != 0; }

void set_parameter(Emission& light, std::string_view key, double value) {
    if (key == "b" || key == "bright" || key == "inten") {
        light.intensity = value > 0 ? value : 1;
    } else if (key == "f" || key == "fract") {
        light.fraction = std::max(value, 0.0);
    } else if (key == "a" || key == "angle") {
        light.angle = std::clamp(value, 0.0, 180.0);
    } else if (key == "s" || key == "shadows") {
        light.shadows = static_cast<int>(std::clamp(value, 0.0, 1e9));
    } else if (key == "i" || key == "infinite") {
        light.infinite = is_set(value);
    } else if (key == "v" || key == "visible") {
        light.visible = is_set(value);
    } else if (key == "invisible") {
        light.visible = !is_set(value);
    }
}

/// Reads a light. `t`, `target` and `aim` give a point; `d`, in the oldest files, gives a direction.
Emission read_light(std::string_view parameters) {
    Emission light;
    while (true) {
        const std::string_view key = next_token(parameters);
        if (key.empty()) return light;
        const bool is_target = key == "t" || key == "target" || key == "aim", is_direction = key == "d";
        if (is_target || is_direction) {
            const auto v = next_numbers<3>(parameters);
            const auto in_range = [](double x) { return std::abs(x) <= Limits::length; };
            if (!v || !std::all_of(v->begin(), v->end(), in_range)) continue;
            const Vec3 vector{(*v)[0], (*v)[1], (*v)[2]};
            if (is_target) light.target = vector;
            if (is_direction && vector != Vec3{}) light.direction = vector;
        } else if (const auto value = next_numbers<1>(parameters)) {
            set_parameter(light, key, value->front());
        }
    }
}

/// The finish of a stack, which is the finish of its last shader of the Phong model.
Finish stack_finish(std::string_view stack) {
    stack = unwrapped(stack);
    Finish finish;
    while (!stack.empty()) {
        std::string_view parameters = next_member(stack);
        if (const auto member = phong_family(next_token(parameters))) {
            finish = *member;
            set_parameters(finish, parameters);
        }
    }
    return finish;
}

}  // namespace

Finish read_finish(std::string_view shader, std::string_view parameters) {
    Finish finish;
    if (const auto known = phong_family(shader)) {
        finish = *known;
        set_parameters(finish, parameters);
    } else if (shader == "stack") {
        finish = stack_finish(parameters);
    } else if (shader == "light") {
        finish.light = read_light(parameters);
    }
    finish.shader = shader;
    return finish;
}

std::string shader_warning(std::string_view shader) {
    for (const std::string_view known : {"", "plastic", "phong", "default", "light"})
        if (shader == known) return {};
    if (shader == "mirror") return "the shader 'mirror' is drawn without reflections, as plastic";
    if (shader == "glass")
        return "the shader 'glass' is drawn opaque, as plastic: neither transparent nor with reflections";
    if (shader == "stack")
        return "the shader 'stack' is drawn as the last plastic, mirror or glass in it, or as plastic";
    return "the shader " + quoted(shader) + " is drawn as plastic";
}

void warn_of_shaders(Scene& scene) {
    std::map<std::string, Warning> warnings;  // by reason, so that their order does not depend on the file's
    const auto add = [&](const Combination& combination, std::string reason) {
        if (reason.empty()) return;
        const auto [found, is_new] =
            warnings.try_emplace(reason, Warning{combination.name, combination.place, reason, 0, true});
        ++found->second.count;
    };
    for (const Object& object : scene.objects) {
        const auto* combination = std::get_if<Combination>(&object);
        if (combination == nullptr || !combination->finish) continue;
        add(*combination, shader_warning(combination->finish->shader));
        if (combination->finish->light && combination->finish->light->shadows > 0)
            add(*combination, "a light casts no shadows here, though it should");
    }
    for (auto& [reason, warning] : warnings) scene.warnings.push_back(std::move(warning));
}

Finish read_finish(std::string_view shader_and_parameters) {
    std::string_view parameters = unwrapped(shader_and_parameters);
    const std::string_view shader = next_token(parameters);
    return read_finish(shader, parameters);
}

}  // namespace csgrt
