// Methods: the numerical methods that a scene can be rendered with. The default of each is recommended.
#pragma once

#include <cstddef>
#include <string_view>
#include <utility>

namespace csgrt {

/// The number type in which rays are intersected with solids. Devices and the reference have the first two.
enum class Precision {
    double_,  ///< 64-bit floats throughout
    single,   ///< 32-bit floats relative to the eye: differences of doubles, rounded once
    quad,     ///< 113 bits, on the reference only: shows the rounding errors of the others
};

/// The rule by which boundaries of segments along one ray count as the same point.
enum class Tolerance {
    length,    ///< boundaries closer than Settings::tolerance in millimetres; by default the scene's tolerance
    surfaces,  ///< boundaries on one surface, as found when the scene is compiled, and boundaries that only rounding
               ///< separates
    relative,  ///< boundaries closer than relative_tolerance() times the diameter of a sphere around the bounded solids
    none,      ///< boundaries at equal distances only
};
/// The tolerance of Tolerance::relative: a share of the diameter of a sphere around the scene's bounded solids, without
/// a unit.
constexpr double relative_tolerance(Precision precision) { return precision == Precision::single ? 1e-6 : 1e-9; }
/// The distance that rounding may make if one surface is computed in two ways (a ball and the end of a part), as a
/// share of the same diameter.
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

/// The name of a value in one of these tables; "" if it has none.
template <class Value, std::size_t count>
constexpr std::string_view name_of(const std::pair<std::string_view, Value> (&names)[count], Value value) {
    for (const auto& [name, named] : names)
        if (named == value) return name;
    return "";
}

}  // namespace csgrt
