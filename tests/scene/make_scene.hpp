// Small scenes made by a program, as a viewer would make them.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

inline Object ball(std::string name, double radius = 1) {
    return Solid{std::move(name), Ell{{}, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}, {}};
}

inline Object solid(std::string name, Shape shape) { return Solid{std::move(name), std::move(shape), {}}; }

inline TreeNode leaf(std::string name, const Matrix& matrix = identity) {
    return {Operator::leaf, 0, std::move(name), matrix, {}};
}

inline TreeNode node(Operator op, std::uint32_t arity) { return {op, arity, {}, identity, {}}; }

inline Tree union_of(const std::vector<std::string>& names) {
    Tree tree;
    for (const std::string& name : names) tree.nodes.push_back(leaf(name));
    tree.nodes.push_back(node(Operator::union_, static_cast<std::uint32_t>(names.size())));
    return tree;
}

inline Object combination(std::string name, Tree tree) {
    Combination made{.name = std::move(name), .tree = std::move(tree)};
    return made;
}

inline Scene make_scene(std::vector<Object> objects) { return {.objects = std::move(objects)}; }

}  // namespace csgrt
