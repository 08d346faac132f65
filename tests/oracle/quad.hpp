// 113-bit arithmetic for the judge of geometry: numbers, vectors and affine maps. Nothing here is shared with kernels/.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include <csgrt/scene.hpp>

namespace csgrt::oracle {

#if __LDBL_MANT_DIG__ == 113
using quad = long double;
#else
using quad = __float128;
#endif

/// Half a unit in the last place of a double near 1.
inline constexpr double double_epsilon = std::numeric_limits<double>::epsilon() / 2;

inline double to_double(quad x) { return static_cast<double>(x); }
inline quad absolute(quad x) { return x < 0 ? -x : x; }
inline quad larger(quad a, quad b) { return a < b ? b : a; }
inline quad smaller(quad a, quad b) { return b < a ? b : a; }

/// Square root to the last bits: Newton on the double's root, 53 -> 106 -> 113 bits.
inline quad root(quad x) {
    if (!(x > 0)) return 0;
    quad y = std::sqrt(to_double(x));
    if (!(y > 0) || y > quad(std::numeric_limits<double>::max())) return y;
    for (int i = 0; i < 2; ++i) y = (y + x / y) / 2;
    return y;
}

/// Of either type, without a detour by the other.
template <class T>
T root_of(T x) {
    if constexpr (sizeof(T) == sizeof(double))
        return x > 0 ? std::sqrt(x) : 0;
    else
        return root(x);
}

struct QVec {
    quad x = 0, y = 0, z = 0;
    QVec() = default;
    QVec(quad x_, quad y_, quad z_) : x(x_), y(y_), z(z_) {}
    QVec(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}

    friend QVec operator+(const QVec& a, const QVec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend QVec operator-(const QVec& a, const QVec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend QVec operator-(const QVec& a) { return {-a.x, -a.y, -a.z}; }
    friend QVec operator*(quad s, const QVec& a) { return {s * a.x, s * a.y, s * a.z}; }
};
inline quad dot(const QVec& a, const QVec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline QVec cross(const QVec& a, const QVec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline quad length(const QVec& a) { return root(dot(a, a)); }
inline QVec unit(const QVec& a) { return (1 / length(a)) * a; }
inline Vec3 to_vec3(const QVec& a) { return {to_double(a.x), to_double(a.y), to_double(a.z)}; }

inline QVec componentwise_absolute(const QVec& a) { return {absolute(a.x), absolute(a.y), absolute(a.z)}; }

/// Some unit vector across `a`.
inline QVec any_across(const QVec& a) {
    const quad x = absolute(a.x), y = absolute(a.y), z = absolute(a.z);
    if (x <= y && x <= z) return unit(cross(a, {1, 0, 0}));
    return unit(cross(a, y <= z ? QVec{0, 1, 0} : QVec{0, 0, 1}));
}

/// p -> x p.x + y p.y + z p.z + origin.
struct QAffine {
    QVec x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin;

    QVec direction(const QVec& d) const { return d.x * x + d.y * y + d.z * z; }
    QVec point(const QVec& p) const { return direction(p) + origin; }
    /// Outer after inner.
    friend QAffine operator*(const QAffine& outer, const QAffine& inner) {
        return {outer.direction(inner.x), outer.direction(inner.y), outer.direction(inner.z),
                outer.point(inner.origin)};
    }
    quad determinant() const { return dot(x, cross(y, z)); }
    QAffine inverse() const {
        const quad d = 1 / determinant();
        const QVec r0 = d * cross(y, z), r1 = d * cross(z, x), r2 = d * cross(x, y);  // rows of the inverse
        QAffine i;
        i.x = {r0.x, r1.x, r2.x};
        i.y = {r0.y, r1.y, r2.y};
        i.z = {r0.z, r1.z, r2.z};
        i.origin = -i.direction(origin);
        return i;
    }
    /// The transpose of the linear part, applied to v: carries a gradient of f(map(p)) back to p.
    QVec transposed(const QVec& v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
};

inline QAffine componentwise_absolute(const QAffine& m) {
    return {componentwise_absolute(m.x), componentwise_absolute(m.y), componentwise_absolute(m.z),
            componentwise_absolute(m.origin)};
}

/// The upper three rows of a csgrt matrix, exactly; its last row is 0 0 0 1.
inline QAffine to_affine(const Matrix& m) {
    return {{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, {m[3], m[7], m[11]}};
}

}  // namespace csgrt::oracle
