// Figures of analyses, for tables and for JSON.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <csgrt/measure.hpp>

#include "base/decimal.hpp"

namespace csgrt::cli {

inline std::string format_number(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

inline std::string percent(double fraction) { return format_number("%.2g", 100 * fraction) + " %"; }
inline std::string relative(const Estimate& e) { return e.value > 0 ? percent(e.half_width / e.value) : "-"; }

inline std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(width, text.size()), ' ');
    return text;
}
inline std::string right(const std::string& text, std::size_t width) {
    return std::string(width - std::min(width, text.size()), ' ') + text;
}

/// Three coordinates with as many digits as `format` says.
inline std::string point_of(const Vec3& p, const char* format = "%.6g") {
    return format_number(format, p.x) + " " + format_number(format, p.y) + " " + format_number(format, p.z);
}

/// A number of JSON, which has no infinite ones.
inline std::string json_figure(double value) { return std::isfinite(value) ? shortest(value) : "null"; }
inline std::string json_point(const Vec3& p) {
    return "[" + json_figure(p.x) + ", " + json_figure(p.y) + ", " + json_figure(p.z) + "]";
}
inline std::string json_corners(const Box& box) {
    return "[" + json_point(box.low) + ", " + json_point(box.high) + "]";
}
inline std::string json_estimate(const Estimate& e) {
    return "[" + json_figure(e.value) + ", " + json_figure(e.half_width) + "]";
}

}  // namespace csgrt::cli
