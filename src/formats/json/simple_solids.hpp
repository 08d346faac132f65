// Simple solids, such as a sphere or a box, whose parameters are easy to write. JSON's reader turns them into the
// model's solids. The writer uses a simple solid if the reader would get the same bits.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <csgrt/scene.hpp>

#include "form/form.hpp"

namespace csgrt {

Ell sphere(const Vec3& center, double radius);

/// Makes a circular cone, or a cylinder if the radii are equal. The axes a and b are perpendicular to the height.
Tgc cone(const Vec3& base, const Vec3& height, double radius, double top_radius);

/// Makes a box along the axes.
Arb box(const Vec3& low, const Vec3& high);

/// Makes arb4 to arb8 from as many vertices as the name says, in BRL-CAD's order:
///   arb8: a face 0 1 2 3 and the opposite face 4 5 6 7, vertex 4 + i above vertex i
///   arb7: arb8 with its last vertex in vertex 4
///   arb6: a face 0 1 2 3, and the edge 4 5 above it: 4 over 0 and 1, 5 over 2 and 3
///   arb5: a pyramid: a face 0 1 2 3, and the apex 4;   arb4: a face 0 1 2, and the apex 3
Arb arb(const std::vector<Vec3>& vertices);

struct Sphere {
    Vec3 center = {};
    double radius = 0;
};
struct Cylinder {
    Vec3 base = {}, height = {};
    double radius = 0;
};
struct Cone {
    Vec3 base = {}, height = {};
    double radius = 0, top_radius = 0;
};
/// A box whose sides are parallel to the axes.
struct UprightBox {
    Vec3 low = {}, high = {};
};
template <std::size_t count>
struct ArbOf {
    std::array<Vec3, count> vertices = {};
};
using Arb4 = ArbOf<4>;
using Arb5 = ArbOf<5>;
using Arb6 = ArbOf<6>;
using Arb7 = ArbOf<7>;

/// Converts to the model's solid.
template <class S>
S model_of(S solid) {
    return solid;
}
inline Ell model_of(const Sphere& s) { return sphere(s.center, s.radius); }
inline Tgc model_of(const Cylinder& s) { return cone(s.base, s.height, s.radius, s.radius); }
inline Tgc model_of(const Cone& s) { return cone(s.base, s.height, s.radius, s.top_radius); }
inline Arb model_of(const UprightBox& s) { return box(s.low, s.high); }
template <std::size_t count>
Arb model_of(const ArbOf<count>& s) {
    return arb({s.vertices.begin(), s.vertices.end()});
}

/// Finds the simple solid that becomes exactly `solid`. False: there is none.
bool simplify(const Ell& solid, Sphere& simple);
bool simplify(const Tgc& solid, Cone& simple);
bool simplify(const Tgc& solid, Cylinder& simple);
bool simplify(const Arb& solid, UprightBox& simple);
bool simplify(const Arb& solid, std::span<Vec3> vertices);
template <std::size_t count>
bool simplify(const Arb& solid, ArbOf<count>& simple) {
    return simplify(solid, std::span<Vec3>(simple.vertices));
}

namespace form {

template <>
inline constexpr auto of<Sphere> = Form{
    simple("sphere"),
    required("center", &Sphere::center, lengths),
    required("radius", &Sphere::radius, length, positive()),
};
template <>
inline constexpr auto of<Cylinder> = Form{
    simple("cylinder"),
    required("base", &Cylinder::base, lengths),
    required("height", &Cylinder::height, lengths, nonzero(), "From the middle of the base to that of the top."),
    required("radius", &Cylinder::radius, length, positive()),
};
template <>
inline constexpr auto of<Cone> = Form{
    simple("cone"),
    required("base", &Cone::base, lengths),
    required("height", &Cone::height, lengths, nonzero()),
    required("radius", &Cone::radius, length, not_negative(), "Of the base. Not both may be 0."),
    filled("top_radius", &Cone::top_radius, length, not_negative()),
};
template <>
inline constexpr auto of<UprightBox> = Form{
    simple("box"),
    required("low", &UprightBox::low, lengths),
    required("high", &UprightBox::high, lengths),
};

constexpr Head arb_heads[] = {simple("arb4"), simple("arb5"), simple("arb6"), simple("arb7")};
constexpr const char* arb_helps[] = {"A triangle, and the apex.", "A quadrilateral, and the apex.",
                                     "A quadrilateral 0 1 2 3, and the edge above it: 4 over 0 and 1, 5 over 2 and 3.",
                                     "As arb8; vertex 7 is vertex 4."};
template <std::size_t count>
inline constexpr auto of<ArbOf<count>> = Form{
    arb_heads[count - 4],
    required("vertices", &ArbOf<count>::vertices, Corners{count}, arb_helps[count - 4]),
};

}  // namespace form

}  // namespace csgrt
