// What a flat tree means: plain evaluation, node by node.
#pragma once

#include <vector>

#include "catch.hpp"
#include "compile/compiled_scene.hpp"

namespace csgrt::test {

/// `covered`: one a solid.
inline bool value_of(const FlatTree& tree, const std::vector<bool>& covered) {
    std::vector<bool> stack;
    for (const FlatTree::Node& node : tree.nodes) {
        if (node.op == Operator::leaf) {
            stack.push_back(covered[node.solid]);
            continue;
        }
        const std::vector<bool> operands(stack.end() - node.arity, stack.end());
        stack.resize(stack.size() - node.arity);
        bool value = operands[0];
        for (std::size_t i = 1; i < operands.size(); ++i)
            value = node.op == Operator::union_         ? value || operands[i]
                    : node.op == Operator::intersection ? value && operands[i]
                    : node.op == Operator::difference   ? value && !operands[i]
                                                        : value != operands[i];
        stack.push_back(node.op == Operator::not_ ? !value : value);
    }
    REQUIRE(stack.size() == 1);
    return stack[0];
}

}  // namespace csgrt::test
