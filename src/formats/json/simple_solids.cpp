#include "formats/json/simple_solids.hpp"

#include <array>
#include <cmath>

#include "scene/vector.hpp"

namespace csgrt {

namespace {

/// For 4 to 8 given vertices: the given vertex that each of an arb's eight vertices is.
constexpr std::array<std::array<std::size_t, 8>, 5> arb_orders = {{
    {0, 1, 2, 0, 3, 3, 3, 3},
    {0, 1, 2, 3, 4, 4, 4, 4},
    {0, 1, 2, 3, 4, 4, 5, 5},
    {0, 1, 2, 3, 4, 5, 6, 4},
    {0, 1, 2, 3, 4, 5, 6, 7},
}};

/// The coordinate axis whose angle to `u` is closest to a right angle.
Vec3 most_perpendicular(const Vec3& u) {
    const double x = std::abs(u.x), y = std::abs(u.y), z = std::abs(u.z);
    if (x <= y && x <= z) return {1, 0, 0};
    return y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
}

}  // namespace

Ell sphere(const Vec3& center, double radius) { return {center, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}; }

Tgc cone(const Vec3& base, const Vec3& height, double radius, double top_radius) {
    const Vec3 u = unit(height);
    const Vec3 across = most_perpendicular(u);
    const Vec3 a = unit(across - dot(across, u) * u);
    const Vec3 b = cross(u, a);
    return {base, height, radius * a, radius * b, top_radius * a, top_radius * b};
}

Arb box(const Vec3& low, const Vec3& high) {
    return {{{{high.x, low.y, low.z},
              {high.x, high.y, low.z},
              {high.x, high.y, high.z},
              {high.x, low.y, high.z},
              {low.x, low.y, low.z},
              {low.x, high.y, low.z},
              {low.x, high.y, high.z},
              {low.x, low.y, high.z}}}};
}

Arb arb(const std::vector<Vec3>& vertices) {
    Arb solid;
    const auto& order = arb_orders.at(vertices.size() - 4);
    for (std::size_t i = 0; i < 8; ++i) solid.vertices[i] = vertices[order[i]];
    return solid;
}

bool simplify(const Ell& solid, Sphere& simple) {
    simple = {solid.v, solid.a.x};
    return simple.radius > 0 && same_bits(model_of(simple), solid);
}

bool simplify(const Tgc& solid, Cone& simple) {
    simple = {solid.v, solid.h, length(solid.a), length(solid.c)};
    return length(solid.h) > 0 && (simple.radius > 0 || simple.top_radius > 0) && same_bits(model_of(simple), solid);
}

bool simplify(const Tgc& solid, Cylinder& simple) {
    Cone as_cone;
    if (!simplify(solid, as_cone)) return false;
    simple = {solid.v, solid.h, as_cone.radius};
    return as_cone.radius == as_cone.top_radius;
}

bool simplify(const Arb& solid, UprightBox& simple) {
    simple = {solid.vertices[4], solid.vertices[2]};
    const auto& [low, high] = simple;
    return low.x < high.x && low.y < high.y && low.z < high.z && same_bits(model_of(simple), solid);
}

bool simplify(const Arb& solid, std::span<Vec3> vertices) {
    for (std::size_t i = 8; i-- > 0;) vertices[arb_orders[vertices.size() - 4][i]] = solid.vertices[i];
    return same_bits(arb({vertices.begin(), vertices.end()}), solid);
}

}  // namespace csgrt
