#include "scene/curved_faults.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace csgrt {

namespace {

bool require_length(Faults& faults, const char* name, const Vec3& vector) {
    if (length(vector) > 0) return true;
    faults.push_back(std::string(name) + " has length 0");
    return false;
}

/// Two vectors, both by name, that must stand at right angles.
void require_perpendicular(Faults& faults, const char* name, const Vec3& vector, const char* other, const Vec3& to) {
    const bool sound = require_length(faults, other, to);
    if (require_length(faults, name, vector) && sound && std::abs(dot(unit(vector), unit(to))) > angle_slack)
        faults.push_back(std::string(name) + " must be perpendicular to " + other);
}

/// Three semi-axes that span space.
void require_axes(Faults& faults, const std::array<std::pair<const char*, Vec3>, 3>& axes) {
    bool sound = true;
    for (const auto& [name, axis] : axes) sound = require_length(faults, name, axis) && sound;
    constexpr double least_volume = 1e-10;  // as for ellipsoids
    if (sound && std::abs(dot(unit(axes[0].second), cross(unit(axes[1].second), unit(axes[2].second)))) < least_volume)
        faults.push_back("the axes lie in one plane");
}

}  // namespace

Faults curved_faults(const Part& s) {
    Faults faults;
    if (!all_finite(faults, s.v, s.h, s.r_v, s.r_h)) return faults;
    if (s.r_v < 0 || s.r_h < 0) faults.push_back("a radius must not be less than 0");
    if (s.r_v == 0 && s.r_h == 0) faults.push_back("one of the two radii must be greater than 0");
    return faults;
}

Faults curved_faults(const Epa& s) {
    Faults faults;
    if (!all_finite(faults, s.v, s.h, s.a, s.r_1, s.r_2)) return faults;
    require_perpendicular(faults, "the direction a", s.a, "the height", s.h);
    require_positive(faults, "the semi-axis r1", s.r_1);
    require_positive(faults, "the semi-axis r2", s.r_2);
    return faults;
}

Faults curved_faults(const Rpc& s) {
    Faults faults;
    if (!all_finite(faults, s.v, s.h, s.b, s.r)) return faults;
    require_perpendicular(faults, "the breadth b", s.b, "the height", s.h);
    require_positive(faults, "the half-width r", s.r);
    return faults;
}

Faults curved_faults(const Rhc& s) {
    Faults faults;
    if (!all_finite(faults, s.v, s.h, s.b, s.r, s.c)) return faults;
    require_perpendicular(faults, "the breadth b", s.b, "the height", s.h);
    require_positive(faults, "the half-width r", s.r);
    require_positive(faults, "c, the distance from the vertex to the asymptotes,", s.c);
    return faults;
}

Faults curved_faults(const Eto& s) {
    Faults faults;
    if (!all_finite(faults, s.v, s.n, s.c, s.r, s.r_d)) return faults;
    require_length(faults, "the axis", s.n);
    require_length(faults, "the semi-axis c", s.c);
    require_positive(faults, "the radius", s.r);
    require_positive(faults, "the semi-axis r_d", s.r_d);
    if (!faults.empty()) return faults;
    const double up = dot(unit(s.c), unit(s.n)), out = std::sqrt(std::fmax(0, (1 - up) * (1 + up)));
    constexpr double rounding = 1 + 1e-12;
    if (std::hypot(out * length(s.c), up * s.r_d) > s.r * rounding)
        faults.push_back("the ellipse must not reach across the axis");
    return faults;
}

Faults curved_faults(const Hyp& s) {
    Faults faults;
    if (!all_finite(faults, s.v, s.h, s.a, s.b, s.neck)) return faults;
    require_perpendicular(faults, "the semi-axis a", s.a, "the height", s.h);
    require_positive(faults, "the semi-axis b", s.b);
    if (!(s.neck > 0 && s.neck < 1)) faults.push_back("the neck's share of the ends must lie between 0 and 1");
    return faults;
}

Faults curved_faults(const Superell& s) {
    Faults faults;
    if (!all_finite(faults, s.v, s.a, s.b, s.c, s.n, s.e)) return faults;
    require_axes(faults, {{{"the axis a", s.a}, {"the axis b", s.b}, {"the axis c", s.c}}});
    for (const auto& [name, exponent] : {std::pair{"n", s.n}, std::pair{"e", s.e}})
        if (!(exponent >= 0.01 && exponent <= 100))
            faults.push_back(std::string("the exponent ") + name + " must lie between 0.01 and 100");
    return faults;
}

Faults curved_faults(const Hrt& s) {
    Faults faults;
    if (!all_finite(faults, s.v, s.x, s.y, s.z, s.d)) return faults;
    require_axes(faults, {{{"the axis x", s.x}, {"the axis y", s.y}, {"the axis z", s.z}}});
    return faults;
}

Faults curved_faults(const Metaball& s) {
    Faults faults;
    if (!all_finite(faults, s.threshold)) return faults;
    for (const Metaball::Point& point : s.points)
        if (!all_finite(faults, point.position, point.strength, point.softness)) return faults;
    return faults;
}

}  // namespace csgrt
