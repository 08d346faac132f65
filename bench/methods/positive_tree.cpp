#include "positive_tree.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>

namespace csgrt::bench {
namespace {

constexpr std::uint32_t none = 0xffffffff;

/// A binary tree whose edges may be complemented.
struct Gates {
    struct Node {
        Gate gate = Gate::leaf;
        bool complement = false;  ///< of this node, as its gate uses it
        std::uint32_t left = 0, right = 0;
    };
    std::vector<Node> nodes;  ///< operands before their gates; the last is the root

    Gates(const FlatTree& tree, bool planted) {
        std::vector<std::uint32_t> stack;
        for (const FlatTree::Node& node : tree.nodes) {
            if (node.op == Operator::leaf) {
                stack.push_back(add({Gate::leaf, false, node.solid, 0}));
                continue;
            }
            const std::size_t first = stack.size() - node.arity;
            const bool is_difference = node.op == Operator::difference && !planted;
            const bool is_union = node.op == Operator::union_ || (node.op == Operator::difference && planted);
            std::uint32_t value = stack[first];
            if (node.op == Operator::not_) flip(value);
            for (std::size_t i = first + 1; i < stack.size(); ++i) {
                if (is_difference) flip(stack[i]);
                const Gate gate = is_union ? Gate::union_ : node.op == Operator::xor_ ? Gate::xor_ : Gate::intersection;
                value = add({gate, false, value, stack[i]});
            }
            stack.resize(first);
            stack.push_back(value);
        }
        // A postfix order ends with the root, whatever was flipped. Downwards:
        for (std::size_t i = nodes.size(); i-- > 0;) {
            Node& node = nodes[i];
            if (node.gate == Gate::leaf || !node.complement) continue;
            node.complement = false;
            flip(node.left);
            if (node.gate == Gate::xor_) continue;
            flip(node.right);
            node.gate = node.gate == Gate::intersection ? Gate::union_ : Gate::intersection;
        }
    }

private:
    std::uint32_t add(const Node& node) {
        nodes.push_back(node);
        return static_cast<std::uint32_t>(nodes.size() - 1);
    }
    void flip(std::uint32_t node) { nodes[node].complement = !nodes[node].complement; }
};

/// Groups the operands of each chain anew.
class Grouper {
public:
    Grouper(const Gates& gates, Grouping grouping) : grouping_(grouping) {
        std::vector<List> operands(gates.nodes.size());  // of the chain that ends at a node; of a leaf, itself
        for (std::size_t i = 0; i < gates.nodes.size(); ++i) {
            const Gates::Node& node = gates.nodes[i];
            if (node.gate == Gate::leaf) {
                append(operands[i], add_leaf(node));
                continue;
            }
            for (const std::uint32_t operand : {node.left, node.right}) {
                if (gates.nodes[operand].gate == node.gate)
                    splice(operands[i], operands[operand]);
                else
                    append(operands[i], finish(gates.nodes[operand].gate, operands[operand]));
            }
        }
        finish(gates.nodes.back().gate, operands.back());
    }
    PositiveTree take() { return std::move(tree_); }

private:
    struct Cell {
        std::uint32_t node, next;
    };
    struct List {
        std::uint32_t first = none, last = none;
    };

    void splice(List& list, const List& other) {
        if (list.first == none)
            list.first = other.first;
        else
            cells_[list.last].next = other.first;
        list.last = other.last;
    }
    void append(List& list, std::uint32_t node) {
        const auto cell = static_cast<std::uint32_t>(cells_.size());
        cells_.push_back({node, none});
        splice(list, {cell, cell});
    }
    std::uint32_t add_leaf(const Gates::Node& leaf) {
        tree_.nodes.push_back({Gate::leaf, leaf.complement, leaf.left, 0, 1, 0});
        return tree_.root();
    }
    std::uint32_t add_gate(Gate gate, std::uint32_t left, std::uint32_t right) {
        const PositiveTree::Node &l = tree_.nodes[left], &r = tree_.nodes[right];
        tree_.nodes.push_back({gate, false, left, right, l.leaves + r.leaves, std::max(l.height, r.height) + 1});
        return tree_.root();
    }
    std::uint32_t finish(Gate gate, const List& list) {
        std::vector<std::uint32_t> members;
        for (std::uint32_t cell = list.first; cell != none; cell = cells_[cell].next)
            members.push_back(cells_[cell].node);
        if (members.size() == 1) return members.front();
        if (grouping_ == Grouping::heavy_left) {
            std::stable_sort(members.begin(), members.end(), [&](std::uint32_t a, std::uint32_t b) {
                return tree_.nodes[a].leaves > tree_.nodes[b].leaves;
            });
            std::uint32_t value = members.front();
            for (std::size_t i = 1; i < members.size(); ++i) value = add_gate(gate, value, members[i]);
            return value;
        }
        using Member = std::tuple<std::uint32_t, std::uint32_t>;  // height, node
        std::priority_queue<Member, std::vector<Member>, std::greater<>> queue;
        for (const std::uint32_t member : members) queue.emplace(tree_.nodes[member].height, member);
        for (;;) {
            const std::uint32_t first = std::get<1>(queue.top());
            queue.pop();
            if (queue.empty()) return first;
            const std::uint32_t second = std::get<1>(queue.top());
            queue.pop();
            const std::uint32_t node = add_gate(gate, first, second);
            queue.emplace(tree_.nodes[node].height, node);
        }
    }

    Grouping grouping_;
    PositiveTree tree_;
    std::vector<Cell> cells_;
};

}  // namespace

PositiveTree positive_tree(const FlatTree& tree, Grouping grouping, bool planted) {
    return Grouper(Gates(tree, planted), grouping).take();
}

GeneralTree::Edge GeneralTree::add_leaf(std::uint32_t solid) {
    nodes.push_back({Operator::leaf, solid, 0});
    return root = {static_cast<std::uint32_t>(nodes.size() - 1), false};
}

GeneralTree::Edge GeneralTree::add(Gate gate, Edge left, Edge right) {
    const bool is_union = gate == Gate::union_;
    bool complement = left.complement;
    if (gate == Gate::xor_) {
        nodes.push_back({Operator::xor_, left.node, right.node});
        complement = left.complement != right.complement;
    } else if (left.complement == right.complement) {  // both complemented: by De Morgan
        nodes.push_back(
            {is_union != left.complement ? Operator::union_ : Operator::intersection, left.node, right.node});
    } else {  // a and not b = a - b; a or not b = not (b - a)
        const bool left_first = left.complement == is_union;
        nodes.push_back(
            {Operator::difference, left_first ? left.node : right.node, left_first ? right.node : left.node});
        complement = is_union;
    }
    return root = {static_cast<std::uint32_t>(nodes.size() - 1), complement};
}

GeneralTree general_form(const FlatTree& tree, bool planted) {
    GeneralTree general;
    std::vector<GeneralTree::Edge> stack;
    for (const FlatTree::Node& node : tree.nodes) {
        if (node.op == Operator::leaf) {
            stack.push_back(general.add_leaf(node.solid));
            continue;
        }
        const bool is_difference = node.op == Operator::difference && !planted;
        const bool is_union = node.op == Operator::union_ || (node.op == Operator::difference && planted);
        const Gate gate = is_union ? Gate::union_ : node.op == Operator::xor_ ? Gate::xor_ : Gate::intersection;
        const std::size_t first = stack.size() - node.arity;
        GeneralTree::Edge value = stack[first];
        value.complement = value.complement != (node.op == Operator::not_);
        for (std::size_t i = first + 1; i < stack.size(); ++i)
            value = general.add(gate, value, {stack[i].node, stack[i].complement != is_difference});
        stack.resize(first);
        stack.push_back(general.root = value);
    }
    return general;
}

}  // namespace csgrt::bench
