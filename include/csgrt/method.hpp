// How a scene is computed: choices to be compared with each other. The default of each is the one to use.
#pragma once

#include <cstddef>
#include <string_view>
#include <utility>

namespace csgrt {

/// In which numbers rays meet solids. The three of them on a device and on the reference.
enum class Precision {
    double_,
    single,        ///< relative to the eye: rays and solids' places in double, their difference rounded to float once
    single_world,  ///< float throughout, in the world's coordinates
    quad,          ///< 113 bits, on the reference only: to see what rounding does to the others
};

/// How quartics (tor, eto, cones with two tapers) are solved.
enum class Quartic {
    bracketed,            ///< origin at the closest approach, roots between those of the derivative
    bracketed_unshifted,  ///< the same with the origin where the ray's is
    ferrari,              ///< closed form
    yuksel,               ///< Yuksel 2022: brackets and Newton, to a stated error
};

/// Which ends of segments along a ray are one.
enum class Tolerance {
    length,    ///< those closer than Settings::tolerance; the scene's, by default
    surfaces,  ///< those on one surface, as found when the scene is compiled, and those that rounding alone sets apart
    relative,  ///< those closer than a share of the scene's size
    none,      ///< only those that are equal
};
/// For Tolerance::relative: of the diameter of a sphere around the scene's bounded solids.
constexpr double relative_tolerance(Precision precision) {
    return precision == Precision::single || precision == Precision::single_world ? 1e-6 : 1e-9;
}
/// What rounding may set apart where one surface is computed in two ways (a ball and the end of a part), of the same
/// diameter.
constexpr double rounding_tolerance(Precision precision) {
    return precision == Precision::single || precision == Precision::single_world ? 1e-6 : 1e-12;
}

/// What the command line and the figures call them.
inline constexpr std::pair<std::string_view, Precision> precision_names[] = {
    {"double", Precision::double_},
    {"single", Precision::single},
    {"single-world", Precision::single_world},
};
inline constexpr std::pair<std::string_view, Quartic> quartic_names[] = {
    {"bracketed", Quartic::bracketed},
    {"bracketed-unshifted", Quartic::bracketed_unshifted},
    {"ferrari", Quartic::ferrari},
    {"yuksel", Quartic::yuksel},
};
inline constexpr std::pair<std::string_view, Tolerance> tolerance_names[] = {
    {"surfaces", Tolerance::surfaces},
    {"relative", Tolerance::relative},
    {"none", Tolerance::none},
};

/// "" for what has no name.
template <class Value, std::size_t count>
constexpr std::string_view name_of(const std::pair<std::string_view, Value> (&names)[count], Value value) {
    for (const auto& [name, named] : names)
        if (named == value) return name;
    return "";
}

}  // namespace csgrt
