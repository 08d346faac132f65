// Laboratory: methods that are kept for measurements beside the default ones. Only benchmarks and tests choose them, by
// Settings::laboratory. They need an OpenCL device or the reference, which has no contraction.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>

#include <csgrt/settings.hpp>

namespace csgrt {

/// Methods for the quartic equations of the solids tor and eto and of cones with two tapers.
enum class Quartic {
    bracketed,  ///< brackets between the derivative's roots; the ray's origin is first moved close to the solid
    bracketed_unshifted,  ///< as `bracketed`, but with the ray's own origin
    ferrari,              ///< closed form
    yuksel,               ///< brackets, and Newton's method until a chosen error (Yuksel 2022)
};
inline constexpr std::pair<std::string_view, Quartic> quartic_names[] = {
    {"bracketed", Quartic::bracketed},
    {"bracketed-unshifted", Quartic::bracketed_unshifted},
    {"ferrari", Quartic::ferrari},
    {"yuksel", Quartic::yuksel},
};

/// The methods that a measurement may choose for a Renderer. Every user has the defaults.
struct Laboratory {
    Quartic quartic = Quartic::bracketed;
    bool contraction = false;   ///< the device's compiler may round a product and a sum as one (fma)
    bool single_world = false;  ///< Precision::single also for the world's coordinates, which are in double otherwise
    const struct Evaluation* evaluation = nullptr;  ///< replaces kernel 4 (pipeline/passes/partitions.hpp)
    std::uint64_t* retried = nullptr;  ///< counts batches that ran again, since their buffers were too small
};

inline const Laboratory& laboratory(const Settings& settings) {
    static const Laboratory defaults;
    return settings.laboratory ? *settings.laboratory : defaults;
}
/// Adds the methods to settings.
inline Settings with_methods(const Laboratory& methods, Settings settings = {}) {
    if (methods.single_world) settings.precision = Precision::single;
    settings.laboratory = std::make_shared<const Laboratory>(methods);
    return settings;
}

}  // namespace csgrt
