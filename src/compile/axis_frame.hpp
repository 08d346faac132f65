// The right-angled frame of a sketch that is turned about an axis.
#pragma once

#include <csgrt/scene.hpp>

#include "compile/linear.hpp"

namespace csgrt {

/// Unit vectors: z along the axis, x where the turn begins, y a quarter on.
struct AxisFrame {
    Wide x, y, z;
};

inline AxisFrame axis_frame(const Revolve& s) {
    const Wide z = glm::normalize(wide(s.axis)), r = wide(s.r);
    const Wide x = glm::normalize(r - glm::dot(r, z) * z);
    return {x, glm::cross(z, x), z};
}

}  // namespace csgrt
