// Frames: the axes of closed-form solids, for packing and for boxes.
#pragma once

#include <cmath>

#include "compile/linear.hpp"

namespace csgrt {

/// A unit vector perpendicular to the unit vector `n`: the cross product with the axis of n's smallest component, which
/// is far from parallel to n.
inline Wide across(const Wide& n) {
    int smallest = 0;
    for (int i = 1; i < 3; ++i)
        if (std::fabs(n[i]) < std::fabs(n[smallest])) smallest = i;
    Wide side(0);
    side[smallest] = 1;
    return glm::normalize(glm::cross(n, side));
}

/// The two semi-axes of the base, and the height.
inline WideMatrix axes_of(const Epa& s) {
    const Wide h = wide(s.h), a = glm::normalize(wide(s.a));
    return {static_cast<long double>(s.r_1) * a, static_cast<long double>(s.r_2) * glm::normalize(glm::cross(h, a)), h};
}
/// Half the length, half the width, and the vector from the base to the vertex.
template <class Cylinder>
WideMatrix axes_of(const Cylinder& s) requires std::is_same_v<Cylinder, Rpc> || std::is_same_v<Cylinder, Rhc> {
    const Wide h = wide(s.h), b = wide(s.b);
    return {0.5L * h, static_cast<long double>(s.r) * glm::normalize(glm::cross(h, b)), b};
}
/// The two semi-axes of the ends, and half the height.
inline WideMatrix axes_of(const Hyp& s) {
    const Wide h = wide(s.h), a = wide(s.a);
    return {a, static_cast<long double>(s.b) * glm::normalize(glm::cross(h, a)), 0.5L * h};
}

/// An elliptical torus in units of its circle's radius.
struct EtoFrame {
    WideMatrix axes;
    long double long_axis, short_axis;  ///< |c| and r_d
    long double radial, axial;          ///< direction of c: away from the axis, along it
};
inline EtoFrame frame_of(const Eto& s) {
    const Wide n = glm::normalize(wide(s.n)), x = across(n), c = wide(s.c);
    const long double r = s.r, length = glm::length(c), up = glm::dot(c, n);
    return {{x * r, glm::cross(n, x) * r, n * r},
            length / r,
            static_cast<long double>(s.r_d) / r,
            glm::length(c - up * n) / length,
            up / length};
}

/// The field of a point. `distance2`: the square of the distance from this point.
inline long double field(const Metaball& s, const Metaball::Point& p, long double distance2) {
    const long double s2 = static_cast<long double>(p.strength) * p.strength;
    switch (s.method) {
        case Metaball::Method::isopotential:
            return s2 / distance2;
        case Metaball::Method::blob:
            return std::exp(p.softness - p.softness * distance2 / s2);
        default: {
            const long double rest = std::fmax(0.0L, 1 - distance2 / s2);
            return rest * rest;
        }
    }
}
/// The natural logarithm of a field that is negligible beside the threshold, even in 113 bits, and even if every point
/// has such a field.
inline long double faint(const Metaball& s) {
    constexpr long double below = 83;  // 2^-120
    return std::log(static_cast<long double>(s.threshold) / s.points.size()) - below;
}
/// The distance from a point at which its field ends: a blob's is cut off where it is negligible.
inline long double field_radius(const Metaball& s, const Metaball::Point& p) {
    switch (s.method) {
        case Metaball::Method::isopotential:
            return HUGE_VALL;
        case Metaball::Method::blob:
            return p.strength * std::sqrt(std::fmax(0.0L, 1 - faint(s) / p.softness));
        default:
            return p.strength;
    }
}
/// A ball that holds a metaball.
struct MetaballFrame {
    Wide center;
    long double reach;
};
inline MetaballFrame frame_of(const Metaball& s) {
    const long double count = s.points.size(), share = s.threshold / count;
    MetaballFrame frame{Wide(0), 0};
    for (const Metaball::Point& p : s.points) frame.center += wide(p.position) / count;
    for (const Metaball::Point& p : s.points) {
        // At each point of the surface, at least one of the metaball's points contributes its share of the threshold.
        // `r` is the greatest distance at which this point can do so.
        long double r = p.strength;
        if (s.method == Metaball::Method::isopotential) r /= std::sqrt(share);
        if (s.method == Metaball::Method::blob) r *= std::sqrt(std::fmax(0.0L, 1 - std::log(share) / p.softness));
        frame.reach = std::fmax(frame.reach, glm::length(wide(p.position) - frame.center) + r);
    }
    return frame;
}

}  // namespace csgrt
