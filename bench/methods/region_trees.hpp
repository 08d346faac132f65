// The regions' trees in the form that the methods with a knob evaluate: every node has two operands, complements stand
// on operands (A - B is A and not B), and n operands of one operator make a tree of height log2(n).
//
// For one ray only little of it is alive: a subtree none of whose solids the ray may meet is the empty set. LiveTrees
// keeps the rest, so that no method pays for solids that are elsewhere.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "compile/compiled_scene.hpp"
#include "gate.hpp"

namespace csgrt::bench {

/// An operand: a node's number << 1, and 1 if it is complemented. Or one of the two sets that need no node.
using Operand = std::uint32_t;
inline constexpr Operand EMPTY_SET = 0xfffffffe, FULL_SET = 0xffffffff;

class RegionTrees {
public:
    struct Node {
        Gate gate = Gate::leaf;
        Operand left = EMPTY_SET, right = EMPTY_SET;
        std::uint32_t parent = NONE, region = 0;
    };
    /// `planted`: every difference is taken for a union.
    RegionTrees(const CompiledScene& scene, bool planted);

    /// Operands come before the nodes that use them, and regions in order of their numbers.
    const std::vector<Node>& nodes() const { return nodes_; }
    Operand root(std::uint32_t region) const { return roots_[region]; }
    const std::vector<std::uint32_t>& leaves_of(std::uint32_t solid) const { return leaves_[solid]; }

private:
    Operand add(Gate gate, Operand left, Operand right);
    Operand balanced(Gate gate, const Operand* operands, std::size_t count);

    std::vector<Node> nodes_;
    std::vector<Operand> roots_;
    std::vector<std::vector<std::uint32_t>> leaves_;
    std::uint32_t region_ = 0;  ///< while it is built
};

/// What a ray needs of the trees. One for each thread; its memory serves ray after ray.
class LiveTrees {
public:
    struct Node {
        Gate gate = Gate::leaf;
        Operand left = EMPTY_SET, right = EMPTY_SET;
        std::uint32_t solid = 0;  ///< leaf: which of the ray's candidates
    };
    struct Root {
        std::uint32_t region;
        Operand operand;            ///< never EMPTY_SET
        std::uint32_t first, last;  ///< the region's nodes
    };

    explicit LiveTrees(const RegionTrees& trees);
    /// `candidates`: solids; all others are empty sets.
    void build(const std::vector<std::uint32_t>& candidates);

    const std::vector<Node>& nodes() const { return nodes_; }
    const std::vector<Root>& roots() const { return roots_; }

    /// A function of the region that is less than 0 inside it, from leaf(candidate) of its solids: a union has the
    /// least of its operands', an intersection the greatest, a complement the negative. The empty set has `outside`,
    /// which is greater than 0. `values` is memory.
    template <class T, class Leaf>
    T function_of(const Root& root, T outside, std::vector<T>& values, const Leaf& leaf) const {
        const auto of = [&](Operand operand) -> T {
            if (operand >= EMPTY_SET) return operand == EMPTY_SET ? outside : static_cast<T>(-outside);
            return operand & 1 ? static_cast<T>(-values[operand >> 1]) : values[operand >> 1];
        };
        values.resize(nodes_.size());
        for (std::uint32_t i = root.first; i < root.last; ++i) {
            const Node& node = nodes_[i];
            if (node.gate == Gate::leaf) {
                values[i] = leaf(node.solid);
                continue;
            }
            const T a = of(node.left), b = of(node.right);
            values[i] = node.gate == Gate::union_         ? std::min(a, b)
                        : node.gate == Gate::intersection ? std::max(a, b)
                                                          : std::max(std::min(a, b), static_cast<T>(-std::max(a, b)));
        }
        return of(root.operand);
    }

private:
    Operand live(Operand operand) const;

    const RegionTrees& trees_;
    std::vector<std::uint64_t> seen_;  ///< by node: the last ray that it was alive for
    std::uint64_t ray_ = 0;
    std::vector<Operand> live_;  ///< by node, where it is alive
    std::vector<std::uint32_t> alive_, candidate_of_;
    std::vector<Node> nodes_;
    std::vector<Root> roots_;
};

}  // namespace csgrt::bench
