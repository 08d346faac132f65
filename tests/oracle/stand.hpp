// Where a random solid stands.
#pragma once

#include "random.hpp"

namespace csgrt::oracle {

/// Three unit vectors at right angles (up to rounding) and a point, in the solid's own space.
struct Stand {
    QVec x, y, z, at;
    double size = 1;

    QVec point(quad a, quad b, quad c) const { return at + quad(size) * (a * x + b * y + c * z); }
    QVec vector(quad a, quad b, quad c) const { return quad(size) * (a * x + b * y + c * z); }
};

inline Stand random_stand(Random& random, double size) {
    Stand s;
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

/// Along the axes, with numbers that sums and products keep exact: rays and faces meet exactly.
inline Stand aligned_stand(Random& random) {
    Stand s;
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
