// Methods: the numerical methods for rendering a scene. The defaults are recommended.
#pragma once

#include <cstddef>
#include <string_view>
#include <utility>

namespace csgrt {

/// The number type in which rays are intersected with solids. The first two are on devices and on the reference.
enum class Precision {
    double_,  ///< 64-bit floats for all numbers
    single,   ///< 32-bit floats relative to the eye, which are differences of doubles, rounded once
    quad,     ///< 113 bits, only on the reference: to find the rounding errors of the other types
};

/// The rule by which boundaries of segments along one ray count as the same point.
enum class Tolerance {
    length,    ///< boundaries closer than Settings::tolerance in millimetres; by default the scene's tolerance
    surfaces,  ///< boundaries on one surface, as found when the scene is compiled, and boundaries that only rounding
               ///< separates
    relative,  ///< boundaries closer than relative_tolerance() times the diameter of a sphere around the bounded solids
    none,      ///< boundaries at equal distances only
};
/// The tolerance of Tolerance::relative, as a fraction of the diameter of a sphere around the scene's bounded solids.
constexpr double relative_tolerance(Precision precision) { return precision == Precision::single ? 1e-6 : 1e-9; }
/// The largest distance between two computations of one surface (for example of a ball, and of the same ball as a
/// part's end), as a fraction of the same diameter.
constexpr double rounding_tolerance(Precision precision) { return precision == Precision::single ? 1e-6 : 1e-12; }

/// Names in the command line and in reports.
inline constexpr std::pair<std::string_view, Precision> precision_names[] = {
    {"double", Precision::double_},
    {"single", Precision::single},
};
inline constexpr std::pair<std::string_view, Tolerance> tolerance_names[] = {
    {"surfaces", Tolerance::surfaces},
    {"relative", Tolerance::relative},
    {"none", Tolerance::none},
};

/// The name of a value in one of these tables, or "".
template <class Value, std::size_t count>
constexpr std::string_view name_of(const std::pair<std::string_view, Value> (&names)[count], Value value) {
    for (const auto& [name, named] : names)
        if (named == value) return name;
    return "";
}

}  // namespace csgrt
