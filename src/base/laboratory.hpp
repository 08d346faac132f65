// Laboratory: methods that are kept for measurements beside the default ones. Only benchmarks and tests choose them, by
// Settings::laboratory. They need an OpenCL device or the reference, which has no contraction.
#pragma once

#include <memory>
#include <string_view>
#include <utility>

#include <csgrt/settings.hpp>

namespace csgrt {

/// Methods for quartic equations, those of tor, eto and cones with two tapers.
enum class Quartic {
    bracketed,            ///< origin at the ray's point closest to the solid; roots lie between the derivative's
    bracketed_unshifted,  ///< the same, with the ray's own origin
    ferrari,              ///< closed form
    yuksel,               ///< brackets and Newton's method to a stated error (Yuksel 2022)
};
inline constexpr std::pair<std::string_view, Quartic> quartic_names[] = {
    {"bracketed", Quartic::bracketed},
    {"bracketed-unshifted", Quartic::bracketed_unshifted},
    {"ferrari", Quartic::ferrari},
    {"yuksel", Quartic::yuksel},
};

/// The methods of a Renderer for measurements. The defaults are those of every user.
struct Laboratory {
    Quartic quartic = Quartic::bracketed;
    bool contraction = false;   ///< the device's compiler may round a product and a sum as one (fma)
    bool single_world = false;  ///< Precision::single in the model's coordinates, without the world in double
    const struct Evaluation* evaluation = nullptr;  ///< in place of kernel 4 (pipeline/passes/partitions.hpp)
};

inline const Laboratory& laboratory(const Settings& settings) {
    static const Laboratory defaults;
    return settings.laboratory ? *settings.laboratory : defaults;
}
/// The settings with these methods.
inline Settings with_methods(const Laboratory& methods, Settings settings = {}) {
    if (methods.single_world) settings.precision = Precision::single;
    settings.laboratory = std::make_shared<const Laboratory>(methods);
    return settings;
}

}  // namespace csgrt
