#include "formats/json/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <nlohmann/json.hpp>

namespace csgrt {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t widest = 118;
constexpr std::size_t step = 2;

/// Appends a value on one line. Stops before the value's end once the text is longer than `limit`.
void append_flat(std::string& out, const ordered_json& value, std::size_t limit) {
    if (value.is_structured()) {
        const bool object = value.is_object();
        out += object ? '{' : '[';
        bool first = true;
        for (const auto& [key, child] : value.items()) {
            if (out.size() > limit) return;
            if (!first) out += ", ";
            first = false;
            if (object) out += json_string(key) + ": ";
            append_flat(out, child, limit);
        }
        out += object ? '}' : ']';
    } else if (value.is_number_float()) {
        out += json_number(value.get<double>());
    } else {
        out += value.dump();
    }
}

bool is_number_list(const ordered_json& value) {
    return value.is_array() &&
           std::all_of(value.begin(), value.end(), [](const ordered_json& item) { return item.is_number(); });
}

/// Appends numbers, as many on each line as fit.
void append_filled(std::string& out, const ordered_json& numbers, std::size_t indent) {
    const std::string line = '\n' + std::string(indent + step, ' ');
    std::size_t column = widest;
    out += '[';
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        std::string item;
        append_flat(item, numbers[i], widest);
        if (i + 1 < numbers.size()) item += ',';
        if (column + 1 + item.size() > widest) {
            out += line;
            column = indent + step;
        } else {
            out += ' ';
            ++column;
        }
        out += item;
        column += item.size();
    }
    out += '\n' + std::string(indent, ' ') + ']';
}

}  // namespace

void append_json(std::string& out, const ordered_json& value, std::size_t indent, std::size_t column) {
    const std::size_t room = column < widest ? widest - column : 0;
    std::string flat;
    append_flat(flat, value, room);
    if (!value.is_structured() || flat.size() <= room) {
        out += flat;
        return;
    }
    if (is_number_list(value)) {
        append_filled(out, value, indent);
        return;
    }
    const bool object = value.is_object();
    out += object ? '{' : '[';
    bool first = true;
    for (const auto& [key, child] : value.items()) {
        const std::string label = object ? json_string(key) + ": " : "";
        out += (first ? "\n" : ",\n") + std::string(indent + step, ' ') + label;
        first = false;
        append_json(out, child, indent + step, indent + step + label.size());
    }
    out += '\n' + std::string(indent, ' ') + (object ? '}' : ']');
}

std::string json_string(const std::string& text) { return nlohmann::json(text).dump(); }

std::string readable_json_string(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string json_number(double value) {
    // Many readers take "-0" for a whole number, and lose its sign.
    if (value == 0 && std::signbit(value)) return "-0.0";
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

}  // namespace csgrt
