// A region's tree in positive form, which bit-parallel evaluation, the status tree and Blists begin with.
//
// Complements are pushed down to the leaves by De Morgan's laws: what is left are and, or and xor over leaves that may
// be complemented (A - B is A and not B; the complement of a xor goes to one of its operands). All three are
// associative and commutative, so operands of a chain may be grouped and ordered as a method likes.
#pragma once

#include <cstdint>
#include <vector>

#include "compile/compiled_scene.hpp"
#include "gate.hpp"

namespace csgrt::bench {

struct PositiveTree {
    struct Node {
        Gate gate = Gate::leaf;
        bool complement = false;  ///< leaf: true where the solid is not
        std::uint32_t left = 0;   ///< leaf: the solid
        std::uint32_t right = 0;
        std::uint32_t leaves = 1, height = 0;
    };
    std::vector<Node> nodes;  ///< operands stand before their gates
    std::uint32_t root() const { return static_cast<std::uint32_t>(nodes.size() - 1); }
};

/// How the operands of a chain of one gate are grouped.
enum class Grouping {
    least_height,  ///< a + b + c + d = (a + b) + (c + d), the flattest operands first
    heavy_left,    ///< ((a + b) + c) + d, those with the most leaves first: the left operand is never the lighter one
};

/// `planted`: every difference is taken for a union, for tests.
PositiveTree positive_tree(const FlatTree& tree, Grouping grouping, bool planted);

/// A tree without complements: A and not B is A - B. Only the root may be complemented: then the region holds the empty
/// space.
struct GeneralTree {
    struct Node {
        Operator op = Operator::leaf;
        std::uint32_t left = 0;  ///< leaf: the solid
        std::uint32_t right = 0;
    };
    /// A node, or its complement.
    struct Edge {
        std::uint32_t node = 0;
        bool complement = false;
    };
    std::vector<Node> nodes;  ///< operands before the nodes that use them
    Edge root;

    Edge add_leaf(std::uint32_t solid);
    Edge add(Gate gate, Edge left, Edge right);
};

/// As it is written: n operands of one operator are a chain to the left.
GeneralTree general_form(const FlatTree& tree, bool planted);

}  // namespace csgrt::bench
