// Angles: degrees in a scene file, radians in the model.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>

namespace csgrt {

inline double radians_of(double degrees) { return degrees / 180 * std::numbers::pi; }

/// The number of degrees that reads back to the same bits. Nothing if there is no such number.
inline std::optional<double> degrees_of(double radians) {
    const double near = radians / std::numbers::pi * 180;
    for (const double candidate :
         {std::round(near), near, std::nextafter(near, -HUGE_VAL), std::nextafter(near, HUGE_VAL)}) {
        const double back = radians_of(candidate);
        if (back == radians && std::signbit(back) == std::signbit(radians)) return candidate;
    }
    return std::nullopt;
}

}  // namespace csgrt
