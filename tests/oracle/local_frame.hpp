// Random coordinate frames, in which the tests place solids.
#pragma once

#include "random.hpp"

namespace csgrt::oracle {

/// A coordinate frame in the solid's own space: three unit vectors, perpendicular up to rounding, an origin and a
/// scale.
struct LocalFrame {
    QVec x, y, z, at;
    double size = 1;

    QVec point(quad a, quad b, quad c) const { return at + quad(size) * (a * x + b * y + c * z); }
    QVec vector(quad a, quad b, quad c) const { return quad(size) * (a * x + b * y + c * z); }
};

inline LocalFrame random_local_frame(Random& random, double size) {
    LocalFrame s;
    s.size = size;
    s.z = random.direction();
    s.x = any_across(s.z);
    const double turn = random.between(-3, 3);
    s.x = quad(std::cos(turn)) * s.x + quad(std::sin(turn)) * cross(s.z, s.x);
    s.x = unit(s.x);
    s.y = cross(s.z, s.x);
    s.at = quad(3 * size) * random.in_cube();
    return s;
}

/// A frame along the axes at a point of small whole numbers. Sums and products of these are exact, so rays can run
/// exactly in faces.
inline LocalFrame aligned_local_frame(Random& random) {
    LocalFrame s;
    s.z = random.axis();
    s.x = any_across(s.z);
    s.y = cross(s.z, s.x);
    s.at = {static_cast<double>(random.below(9)) - 4, static_cast<double>(random.below(9)) - 4,
            static_cast<double>(random.below(9)) - 4};
    return s;
}

namespace detail {

inline Vec3 v(const QVec& q) { return to_vec3(q); }

}  // namespace detail

}  // namespace csgrt::oracle
