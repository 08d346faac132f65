// Small scenes, built in code.
#pragma once

#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include <csgrt/scene.hpp>

#include "thrown.hpp"

namespace csgrt::test {

inline TreeNode leg(const std::string& object, const Matrix& matrix = identity) {
    return {Operator::leaf, 0, object, matrix, {}};
}
inline TreeNode op(Operator which, std::uint32_t arity) { return {which, arity, {}, identity, {}}; }

// What stands in trees below.
inline const TreeNode both = op(Operator::intersection, 2), either = op(Operator::union_, 2);
inline const TreeNode less = op(Operator::difference, 2), one_of = op(Operator::xor_, 2), not_ = op(Operator::not_, 1);

inline Solid solid(const std::string& name, Shape shape) {
    return {name, std::move(shape), {"scene.json", 1, 1, -1, name}};
}
inline Solid ball(const std::string& name, const Vec3& center = {}, double radius = 1) {
    return solid(name, Ell{center, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}});
}
inline Arb block_shape(const Vec3& low, const Vec3& high) {
    return {{{{low.x, low.y, low.z},
              {high.x, low.y, low.z},
              {high.x, high.y, low.z},
              {low.x, high.y, low.z},
              {low.x, low.y, high.z},
              {high.x, low.y, high.z},
              {high.x, high.y, high.z},
              {low.x, high.y, high.z}}}};
}
inline Solid block(const std::string& name, const Vec3& low, const Vec3& high) {
    return solid(name, block_shape(low, high));
}

inline Combination group(const std::string& name, std::vector<TreeNode> nodes) {
    Combination c{.name = name};
    c.tree.nodes = std::move(nodes);
    c.place = {"scene.json", 7, 3, -1, name};
    return c;
}
inline Combination region(const std::string& name, std::vector<TreeNode> nodes, int id = 1000) {
    Combination c = group(name, std::move(nodes));
    c.region = true;
    c.region_id = id;
    return c;
}

inline Scene scene(std::initializer_list<Object> objects) { return {.objects = objects}; }

inline Matrix moved(double x, double y, double z) { return {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1}; }
/// About the z axis.
inline Matrix turned(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
}
/// About an axis that no face is parallel to, and away from the origin.
inline Matrix askew(double angle, const Vec3& offset = {}) {
    const double x = 0.36, y = 0.48, z = 0.8, c = std::cos(angle), s = std::sin(angle), k = 1 - c;
    return {c + x * x * k,
            x * y * k - z * s,
            x * z * k + y * s,
            offset.x,
            y * x * k + z * s,
            c + y * y * k,
            y * z * k - x * s,
            offset.y,
            z * x * k - y * s,
            z * y * k + x * s,
            c + z * z * k,
            offset.z,
            0,
            0,
            0,
            1};
}

/// What a call throws as Error; empty if it does not.
template <class Call>
std::string error_of(const Call& call) {
    return thrown_by(call).text;
}
inline bool near(double a, double b, double slack = 1e-12) { return std::abs(a - b) <= slack; }

}  // namespace csgrt::test
