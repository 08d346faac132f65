// Points, matrices and boxes.
#pragma once

#include <array>

namespace csgrt {

/// A point, a displacement, a direction, or a colour (red, green, blue).
struct Vec3 {
    double x = 0, y = 0, z = 0;
    friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// A 4 x 4 matrix, row-major, for column vectors: p' = M p. The last row is 0 0 0 1. (In BRL-CAD's files the last
/// element is 1 / scale; the readers divide by it.)
using Matrix = std::array<double, 16>;
inline constexpr Matrix identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// An axis-aligned box. The box is empty if any coordinate of `low` is greater than the same coordinate of `high`.
struct Box {
    Vec3 low = {}, high = {};
};

}  // namespace csgrt
