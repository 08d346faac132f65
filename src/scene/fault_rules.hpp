// Rules that the faults of solids share.
#pragma once

#include <string>
#include <vector>

#include "scene/vector.hpp"

namespace csgrt {

using Faults = std::vector<std::string>;

/// Sine of the angle that vectors called parallel (cosine: perpendicular) may differ by. BRL-CAD's databases keep
/// vectors of single precision, off by up to 1e-6; its ray tracer refuses beyond a cosine of 0.999.
inline constexpr double angle_slack = 1e-3;

/// Reports a number that is not finite, once a solid. Nothing else is worth saying about such a solid.
template <class... Numbers>
bool all_finite(Faults& faults, const Numbers&... numbers) {
    struct {
        bool operator()(double x) const { return std::isfinite(x); }
        bool operator()(const Vec3& v) const { return is_finite(v); }
    } finite;
    if ((finite(numbers) && ...)) return true;
    faults.push_back("it has a number that is not finite");
    return false;
}

inline void require_positive(Faults& faults, const char* name, double value) {
    if (!(value > 0)) faults.push_back(std::string(name) + " must be greater than 0");
}

}  // namespace csgrt
