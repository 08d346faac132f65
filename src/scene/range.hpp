// Range: limits of numbers, beyond which results would overflow or underflow, and the messages about such numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <csgrt/scene.hpp>

namespace csgrt {

inline double largest(double x) { return std::abs(x); }
inline double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// The shortest decimal that is read as the same double.
std::string number_text(double x);

/// The number with six digits.
std::string rounded_text(double x);

/// "the largest size and distance from the origin is 1e+15 mm"
std::string length_limit();

/// The reason why a ray cannot be traced, or an empty text. `in_direction`: true if the direction is at fault, false if
/// the origin is.
std::string ray_fault(const Vec3& origin, const Vec3& direction, bool& in_direction);

}  // namespace csgrt
