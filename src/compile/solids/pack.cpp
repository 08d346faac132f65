#include "compile/solids/pack.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "compile/solids/packer.hpp"
#include "compile/solids/polyhedron.hpp"

namespace csgrt {

namespace {

// The ratio of a cone's ends below which the smaller end is a point. An end that is so small in one direction only
// keeps its width.
constexpr long double pointed = 1e-12L;
// The difference below which the tapers of a and b are equal: the cone is a quadric.
constexpr long double same_taper = 1e-9L;

/// Semi-axes as p0 + p1 z, in units of the larger end.
struct Taper {
    Wide axis;  ///< of the larger end
    long double p0, p1;
};
Taper taper(const Vec3& base, const Vec3& top, bool base_is_point, bool top_is_point) {
    long double at_base = glm::length(wide(base)), at_top = glm::length(wide(top));
    const long double larger = std::max(at_base, at_top);
    const Wide direction = glm::normalize(at_base > 0 ? wide(base) : wide(top));
    at_base = base_is_point ? 0 : at_base / larger;
    at_top = top_is_point ? 0 : at_top / larger;
    return {direction * larger, 0.5L * (at_base + at_top), 0.5L * (at_top - at_base)};
}

/// Is the end with semi-axes `a` and `b` a point, compared with the other end?
bool is_point(const Vec3& a, const Vec3& b, const Vec3& other_a, const Vec3& other_b) {
    return glm::length(wide(a)) < pointed * glm::length(wide(other_a)) &&
           glm::length(wide(b)) < pointed * glm::length(wide(other_b));
}

}  // namespace

void Packer::frame(const Wide& center, const WideMatrix& axes) {
    const Wide c = transform_point(matrix, center);
    axes_in_world = linear_part(matrix) * axes;
    const WideMatrix inverse = glm::inverse(axes_in_world);
    for (int i = 0; i < 3; ++i) real(c[i]);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) real(inverse[column][row]);
}

void Packer::faces(std::span<const Plane> all) {
    planes.insert(planes.end(), all.begin(), all.end());
    is_polyhedron = true;
}

void Packer::operator()(const Ell& s) {
    record.type = SOLID_ELL;
    frame(wide(s.v), {wide(s.a), wide(s.b), wide(s.c)});
}

void Packer::operator()(const Tgc& s) {
    record.type = SOLID_TGC;
    const Wide half = 0.5L * wide(s.h);
    const bool base_is_point = is_point(s.a, s.b, s.c, s.d), top_is_point = is_point(s.c, s.d, s.a, s.b);
    const Taper a = taper(s.a, s.c, base_is_point, top_is_point);
    Taper b = taper(s.b, s.d, base_is_point, top_is_point);
    // |A||D| = |B||C|, in units of the larger ends.
    const long double ad = (a.p0 - a.p1) * (b.p0 + b.p1), bc = (b.p0 - b.p1) * (a.p0 + a.p1);
    const bool quadric = std::fabs(ad - bc) <= same_taper * std::max(ad, bc);
    if (quadric) b = {b.axis, a.p0, a.p1};
    // The origin is the middle of the axis, or the apex of a cone that has one.
    const bool apex = quadric && a.p0 == std::fabs(a.p1);
    const Wide middle = wide(s.v) + half;
    frame(!apex ? middle : a.p1 < 0 ? middle + half : middle - half, {a.axis, b.axis, half});
    real(apex ? 0 : a.p0);
    real(a.p1);
    real(b.p0);
    real(b.p1);
    real(quadric ? 0 : 1);
    real(2.000001L);  // z is 1 at the ends, and the larger semi-axes are 1: x^2 + y^2 + z^2 <= 2, with a margin

    const Wide normal = transform_direction(matrix, half);
    Wide cap = glm::cross(transform_direction(matrix, a.axis), transform_direction(matrix, b.axis));
    if (glm::dot(cap, normal) < 0) cap = -cap;
    face(plane_through(transform_point(matrix, wide(s.v)), -cap));
    face(plane_through(transform_point(matrix, wide(s.v) + wide(s.h)), cap));
}

void Packer::operator()(const Arb& s) {
    record.type = SOLID_ARB;
    faces(arb_faces(s, matrix).planes);
}

void Packer::operator()(const Arbn& s) {
    record.type = SOLID_ARB;
    faces(arbn_faces(s, matrix));
}

void Packer::operator()(const Half& s) {
    record.type = SOLID_HALF;
    face(transform_plane(matrix, s.plane));
}

void Packer::operator()(const Tor& s) {
    record.type = SOLID_TOR;
    const Wide h = glm::normalize(wide(s.h));
    // The side is the axis of h's smallest component, so that it is far from parallel to h.
    Wide side(0);
    int smallest = 0;
    for (int i = 1; i < 3; ++i)
        if (std::fabs(h[i]) < std::fabs(h[smallest])) smallest = i;
    side[smallest] = 1;
    const Wide x = glm::normalize(glm::cross(h, side));
    const long double r = s.r_a;
    frame(wide(s.v), {x * r, glm::cross(h, x) * r, h * r});
    real(static_cast<long double>(s.r_h) / s.r_a);
}

void Packer::operator()(const Ehy& s) {
    record.type = SOLID_EHY;
    const Wide h = wide(s.h), a = glm::normalize(wide(s.a));
    const Wide b = glm::normalize(glm::cross(h, a));
    const Wide x = a * static_cast<long double>(s.r_1), y = b * static_cast<long double>(s.r_2);
    frame(wide(s.v) + 0.5L * h, {x, y, 0.5L * h});
    real(static_cast<long double>(s.c) / glm::length(h));

    Wide cap = glm::cross(transform_direction(matrix, x), transform_direction(matrix, y));
    if (glm::dot(cap, transform_direction(matrix, h)) > 0) cap = -cap;
    face(plane_through(transform_point(matrix, wide(s.v)), cap));
}

// Solids that are made of other solids are never packed whole: see solid_parts.cpp.
void Packer::operator()(const Pipe&) { throw std::logic_error("a pipe is packed piece by piece"); }
void Packer::operator()(const Cline&) { throw std::logic_error("a cline is packed piece by piece"); }

void Packer::operator()(const Unsupported& s) {
    throw Error(Status::scene, "solids of type '" + s.type + "' cannot be rendered");
}

}  // namespace csgrt
