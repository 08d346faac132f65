// Folding: Boolean operators over operands of which some are constants.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <csgrt/scene.hpp>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// An operand: a tree of solids, the empty set, or all of space.
enum class Value : std::uint8_t { tree, nothing, everything };

/// The result of folding an operator.
struct Folded {
    Value value;  ///< Value::tree: `op` over the operands that are trees, in their order
    std::size_t trees;
    Operator op;
    bool complement;  ///< of the tree
};

/// Folds an operator. `operands`: at least one; for a complement exactly one.
inline Folded fold(Operator op, std::span<const Value> operands) {
    const auto count = [&](Value value) {
        return static_cast<std::size_t>(std::count(operands.begin(), operands.end(), value));
    };
    const std::size_t trees = count(Value::tree), wholes = count(Value::everything);
    const auto tree_or = [&](Value constant) { return trees > 0 ? Value::tree : constant; };
    const auto result = [&](Value value, Operator operation, bool complement = false) {
        if (complement && value != Value::tree) value = value == Value::nothing ? Value::everything : Value::nothing;
        return Folded{value, trees, operation, complement};
    };
    switch (op) {
        case Operator::union_:
            return result(wholes > 0 ? Value::everything : tree_or(Value::nothing), op);
        case Operator::intersection:
            return result(count(Value::nothing) > 0 ? Value::nothing : tree_or(Value::everything), op);
        case Operator::difference:
            if (operands[0] == Value::nothing || wholes > (operands[0] == Value::everything ? 1 : 0))
                return result(Value::nothing, op);
            if (operands[0] == Value::tree) return result(Value::tree, op);
            return result(tree_or(Value::nothing), Operator::union_, true);
        case Operator::xor_:
            return result(tree_or(Value::nothing), op, wholes % 2 == 1);
        default:  // a complement
            return result(operands[0], op, true);
    }
}

/// Appends the operator after its operands, whose nodes begin at `first`; a constant result has no nodes. Returns the
/// result's value.
inline Value append_folded(std::vector<FlatTree::Node>& nodes, std::size_t first, Operator op,
                           std::span<const Value> operands) {
    const Folded folded = fold(op, operands);
    if (folded.value == Value::tree) {
        if (folded.trees > 1) nodes.push_back({folded.op, static_cast<std::uint32_t>(folded.trees), 0});
        if (folded.complement) nodes.push_back({Operator::not_, 1, 0});
    } else {
        nodes.resize(first);
    }
    return folded.value;
}

}  // namespace csgrt
