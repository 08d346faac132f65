#include "statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "base/decimal.hpp"
#include "form/answers.hpp"
#include "partitions.hpp"

namespace csgrt::cli {

namespace {

std::string milliseconds(double value) {
    char text[64];
    std::snprintf(text, sizeof text, "%.4f", std::isfinite(value) ? value : 0.0);  // JSON has no infinity
    return text;
}

}  // namespace

std::string json_text(std::string_view text) {
    std::string out = "\"";
    for (char c : text) {
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (static_cast<unsigned char>(c) < 0x20) {
            char escape[8];
            std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(c));
            out += escape;
        } else {
            out += c;
        }
    }
    return out + '"';
}

std::string to_json(const Statistics& s) {
    std::string out = "{", group;
    form::for_members(form::of<Statistics>, [&](const auto& member) {
        const auto& value = form::member_of(member, s);
        const std::string_view key = member.key.json;
        if (key == "height") return;  // printed with the width
        const std::size_t point = std::min(key.find('.'), key.size());
        const std::string of(key, 0, point == key.size() ? 0 : point);
        if (!group.empty() && of != group) out += "}";
        const bool goes_on = !of.empty() && of == group;
        out += out == "{" ? "\n  " : goes_on ? ", " : ",\n  ";
        if (!of.empty() && !goes_on) out += json_text(of) + ": {";
        group = of;
        const std::string_view name = of.empty() ? key : key.substr(point + 1);
        out += (key == "width" ? json_text("size") : json_text(name)) + ": ";
        using Value = std::remove_cvref_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, std::string>)
            out += json_text(value);
        else if constexpr (std::is_same_v<Value, double>)
            out += of == "ms" ? milliseconds(value) : shortest(value);
        else if (key == "width")
            out += "[" + std::to_string(s.width) + ", " + std::to_string(s.height) + "]";
        else
            out += std::to_string(value);
    });
    return out + (group.empty() ? "\n}\n" : "}\n}\n");
}

Statistics median_of(const std::vector<Statistics>& frames) {
    Statistics result = frames.back();
    const auto warm = frames.begin() + (frames.size() > 1 ? 1 : 0);
    std::vector<double> values;
    form::for_members(form::of<Statistics>, [&](const auto& member) {
        auto& median = form::member_of(member, result);
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(median)>, double>) {
            values.clear();
            for (auto frame = warm; frame != frames.end(); ++frame) values.push_back(form::member_of(member, *frame));
            std::sort(values.begin(), values.end());
            const std::size_t half = values.size() / 2;
            median = values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
        }
    });
    return result;
}

}  // namespace csgrt::cli
