// Vectors: the algebra that the model's checks and readers need.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include <csgrt/scene.hpp>

#include "base/identical.hpp"

namespace csgrt {

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec3& a) { return std::hypot(a.x, a.y, a.z); }
inline bool is_finite(const Vec3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

/// A quick test without roots: do three vectors surely span more than 1e-9 of the volume of a right-angled box with
/// these edges? It may be false though they do.
inline bool plainly_independent(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double volume = dot(a, cross(b, c)), squares = dot(a, a) * dot(b, b) * dot(c, c);
    return squares > 1e-280 && volume * volume > 1e-18 * squares;
}

/// `a` scaled to length 1; `a` itself if its length is 0. hypot does not overflow or underflow in between.
inline Vec3 unit(const Vec3& a) {
    const double l = length(a);
    return l == 0 ? a : Vec3{a.x / l, a.y / l, a.z / l};
}

/// The matrix that applies `inner`, then `outer`. Each element is summed from left to right, as in BRL-CAD.
inline Matrix compose(const Matrix& outer, const Matrix& inner) {
    Matrix m{};
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column) {
            for (std::size_t k = 0; k < 4; ++k) m[4 * row + column] += outer[4 * row + k] * inner[4 * k + column];
        }
    }
    return m;
}

/// Solves outer x = inner for the matrix x. Nothing if `outer` is not affine, or its inverse has an infinite number.
inline std::optional<Matrix> divide(const Matrix& outer, const Matrix& inner) {
    const Vec3 x{outer[0], outer[4], outer[8]}, y{outer[1], outer[5], outer[9]}, z{outer[2], outer[6], outer[10]};
    const double volume = dot(x, cross(y, z));
    const Vec3 rows[] = {1 / volume * cross(y, z), 1 / volume * cross(z, x), 1 / volume * cross(x, y)};
    Matrix inverse = identity;
    for (std::size_t row = 0; row < 3; ++row) {
        const Vec3& r = rows[row];
        const double numbers[] = {r.x, r.y, r.z, -dot(r, {outer[3], outer[7], outer[11]})};
        for (std::size_t column = 0; column < 4; ++column) inverse[4 * row + column] = numbers[column];
    }
    const bool is_affine = outer[12] == 0 && outer[13] == 0 && outer[14] == 0 && outer[15] == 1;
    for (const double number : inverse)
        if (!is_affine || !std::isfinite(number)) return {};
    return compose(inverse, inner);
}

/// The difference from length 1 within which a vector counts as a unit vector and keeps its bits.
inline constexpr double unit_slack = 1e-9;
inline bool is_unit(const Vec3& a) { return std::abs(length(a) - 1) <= unit_slack; }

/// The fraction of a right-angled box's volume below which three vectors count as lying in a plane: the inverse of
/// their matrix has no correct digits in double precision.
inline constexpr double least_volume = 1e-10;

inline bool dependent(const Vec3& a, const Vec3& b, const Vec3& c) {
    return !plainly_independent(a, b, c) && std::abs(dot(unit(a), cross(unit(b), unit(c)))) < least_volume;
}

}  // namespace csgrt
