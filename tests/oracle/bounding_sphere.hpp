// Bounding spheres. Most rays miss most solids, and this test in double precision skips the solids that a ray misses
// whatever rounding does.
#pragma once

#include <cmath>

#include "quad.hpp"

namespace csgrt::oracle {

/// A sphere around a solid or a triangle; by default all of space.
struct BoundingSphere {
    Vec3 center;
    double radius = HUGE_VAL;  ///< millimetres
    double widening = 0;       ///< growth of the radius for each unit of distance from the line's start

    /// Is the line from o along d farther than `near` from the sphere, for certain?
    bool is_missed_by(const Vec3& o, const Vec3& d, double near = 0) const {
        if (radius == HUGE_VAL) return false;
        const double x = center.x - o.x, y = center.y - o.y, z = center.z - o.z;
        const double a = y * d.z - z * d.y, b = z * d.x - x * d.z, c = x * d.y - y * d.x;
        const double far = std::abs(x) + std::abs(y) + std::abs(z),
                     start = std::abs(o.x) + std::abs(o.y) + std::abs(o.z);
        const double most = radius + near + widening * far + 64 * double_epsilon * (far + start);
        return a * a + b * b + c * c > 1.000001 * most * most * (d.x * d.x + d.y * d.y + d.z * d.z);
    }
};

}  // namespace csgrt::oracle
