// The value of a tree in code, leaf by leaf: by definition, without a tree of csgrt's own.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

#include "catch.hpp"

namespace csgrt::test {

/// `is_true(name)`: the value of a leaf.
template <class IsTrue>
bool value_of(const Tree& tree, const IsTrue& is_true) {
    std::vector<bool> stack;
    for (const TreeNode& node : tree.nodes) {
        if (node.op == Operator::leaf) {
            stack.push_back(is_true(node.object));
            continue;
        }
        const std::size_t first = stack.size() - node.arity;
        bool value = stack[first];
        for (std::size_t i = first + 1; i < stack.size(); ++i) {
            if (node.op == Operator::union_) value = value || stack[i];
            if (node.op == Operator::intersection) value = value && stack[i];
            if (node.op == Operator::difference) value = value && !stack[i];
            if (node.op == Operator::xor_) value = value != stack[i];
        }
        if (node.op == Operator::not_) value = !value;
        stack.resize(first);
        stack.push_back(value);
    }
    REQUIRE(stack.size() == 1);
    return stack.front();
}

}  // namespace csgrt::test
