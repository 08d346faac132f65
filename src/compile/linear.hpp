// Linear algebra of compilation: vectors and matrices in long double, rounded once when they are packed.
#pragma once

#include <limits>

#include <glm/glm.hpp>

#include <csgrt/scene.hpp>

namespace csgrt {

using Wide = glm::vec<3, long double>;
using WideMatrix = glm::mat<3, 3, long double>;  // columns

inline Wide wide(const Vec3& v) { return {v.x, v.y, v.z}; }
inline Vec3 narrow(const Wide& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

inline Wide transform_point(const Matrix& m, const Wide& p) {
    return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
            m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
}
inline Wide transform_direction(const Matrix& m, const Wide& v) {
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[4] * v.x + m[5] * v.y + m[6] * v.z,
            m[8] * v.x + m[9] * v.y + m[10] * v.z};
}
inline WideMatrix linear_part(const Matrix& m) {
    return {Wide(m[0], m[4], m[8]), Wide(m[1], m[5], m[9]), Wide(m[2], m[6], m[10])};
}

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr Box empty_box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
inline constexpr Box whole_space{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};

inline bool is_empty(const Box& box) {
    return !(box.low.x <= box.high.x && box.low.y <= box.high.y && box.low.z <= box.high.z);
}
inline bool is_finite(const Box& box) {
    return box.low.x > -infinity && box.low.y > -infinity && box.low.z > -infinity && box.high.x < infinity &&
           box.high.y < infinity && box.high.z < infinity;
}
inline void extend(Box& box, const Vec3& p) {
    box.low = {glm::min(box.low.x, p.x), glm::min(box.low.y, p.y), glm::min(box.low.z, p.z)};
    box.high = {glm::max(box.high.x, p.x), glm::max(box.high.y, p.y), glm::max(box.high.z, p.z)};
}
inline Box united(const Box& a, const Box& b) {
    return {{glm::min(a.low.x, b.low.x), glm::min(a.low.y, b.low.y), glm::min(a.low.z, b.low.z)},
            {glm::max(a.high.x, b.high.x), glm::max(a.high.y, b.high.y), glm::max(a.high.z, b.high.z)}};
}
inline Box intersected(const Box& a, const Box& b) {
    return {{glm::max(a.low.x, b.low.x), glm::max(a.low.y, b.low.y), glm::max(a.low.z, b.low.z)},
            {glm::min(a.high.x, b.high.x), glm::min(a.high.y, b.high.y), glm::min(a.high.z, b.high.z)}};
}
/// The rounding error of a world coordinate after a few matrices, relative to the largest coordinate.
inline constexpr double coordinate_rounding = 0x1p-49;
inline double largest_coordinate(const Box& box) {
    const auto largest = [](const Vec3& p) { return glm::max(glm::abs(p.x), glm::max(glm::abs(p.y), glm::abs(p.z))); };
    return glm::max(largest(box.low), largest(box.high));
}
inline double largest_coordinate(const Vec3& center, double radius) {
    return largest_coordinate({center, center}) + radius;
}

inline double diagonal(const Box& box) {
    return glm::length(glm::dvec3(box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z));
}

}  // namespace csgrt
