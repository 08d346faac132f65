// Axis frame: the right-angled frame of a sketch that is turned about an axis.
#pragma once

#include <cmath>
#include <numbers>

#include <csgrt/scene.hpp>

#include "compile/linear.hpp"
#include "compile/solids/planes.hpp"

namespace csgrt {

/// Unit vectors: z along the axis, x where the turn begins, y a quarter turn on.
struct AxisFrame {
    Wide x, y, z;
};

inline AxisFrame axis_frame(const Revolve& s) {
    const Wide z = glm::normalize(wide(s.axis)), r = wide(s.r);
    const Wide x = glm::normalize(r - glm::dot(r, z) * z);
    return {x, glm::cross(z, x), z};
}

/// The size of a turn. The half planes where the turn begins and ends are one plane if the angle between them is within
/// the limit for equal planes. Then the turn is whole, without a seam, or it is none. In half a turn the two half
/// planes lie in one plane.
enum class Turn { none, less, half, more, whole };

inline Turn turn_of(const Revolve& s) {
    constexpr long double pi = std::numbers::pi_v<long double>, limit = PlaneTable::gap;
    const long double angle = s.angle;
    if (angle <= limit) return Turn::none;
    if (angle >= 2 * pi - limit) return Turn::whole;
    if (std::fabs(angle - pi) <= limit) return Turn::half;
    return angle < pi ? Turn::less : Turn::more;
}

}  // namespace csgrt
