// Linearizing: turns a tree into a balanced binary tree. Each operand on the stack is one of
//
//     any of p      all of p, none of n      an odd number of p
//
// where p and n are lists of finished binary nodes, or the complement of such a set. Unions, intersections and
// differences all come from "all of p, none of n" by de Morgan's laws, so chains of one kind become one list,
// complements move upward until they vanish, and x - (y - z) or x + !y need no special case. At last a list becomes a
// balanced tree, so the walk to any leaf is short, however long the model's chain is. Lists are linked, so joining two
// lists takes constant time.

#include "compile/regions/linearize.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <string>
#include <tuple>

namespace csgrt {

void check_tree_words(std::uint64_t count) {
    if (count > std::uint64_t{TREE_MASK} + 1)
        throw Error(Status::scene, "the trees of all regions together exceed " + std::to_string(TREE_MASK) + " words");
}

namespace {

constexpr std::uint32_t none = 0xffffffff;

/// Builds a balanced binary tree without complements from a region's tree, and writes it as words.
class Linearizer {
public:
    std::uint32_t build(const FlatTree& tree);
    LinearTree write(std::uint32_t root, std::vector<std::uint32_t>& words) const;

private:
    struct Node {
        std::uint32_t op, left, right;  // leaf: left is the solid
        std::uint32_t stack;
    };
    struct Cell {
        std::uint32_t node, next;
    };
    struct List {
        std::uint32_t first = none, last = none;
        bool empty() const { return first == none; }
    };
    enum class Kind { any, all, odd };
    struct Operand {
        Kind kind;
        List p, n;
        bool complement;
    };

    void append(List& list, std::uint32_t node);
    void splice(List& list, const List& other);
    bool is_single(const Operand& operand) const { return operand.n.empty() && operand.p.first == operand.p.last; }
    std::uint32_t finish(const Operand& operand);
    Operand conjunction(std::size_t first);
    Operand parity(std::size_t first);
    std::uint32_t add_leaf(std::uint32_t solid);
    std::uint32_t add_node(std::uint32_t op, std::uint32_t left, std::uint32_t right);
    std::uint32_t add_difference(std::uint32_t from, std::uint32_t what);
    std::uint32_t join(std::uint32_t op, const List& list);

    std::vector<Node> nodes_;
    std::vector<Cell> cells_;
    std::vector<Operand> operands_;
};

void Linearizer::append(List& list, std::uint32_t node) {
    const auto cell = static_cast<std::uint32_t>(cells_.size());
    cells_.push_back({node, none});
    splice(list, {cell, cell});
}

void Linearizer::splice(List& list, const List& other) {
    if (other.empty()) return;
    if (list.empty()) {
        list = other;
    } else {
        cells_[list.last].next = other.first;
        list.last = other.last;
    }
}

std::uint32_t Linearizer::add_leaf(std::uint32_t solid) {
    nodes_.push_back({OP_LEAF, solid, none, 0});
    return static_cast<std::uint32_t>(nodes_.size() - 1);
}

// The size of the walk's stack: the walk pushes an entry for a left child, but not for a right child.
std::uint32_t Linearizer::add_node(std::uint32_t op, std::uint32_t left, std::uint32_t right) {
    nodes_.push_back({op, left, right, std::max(nodes_[left].stack + 1, nodes_[right].stack)});
    return static_cast<std::uint32_t>(nodes_.size() - 1);
}

std::uint32_t Linearizer::add_difference(std::uint32_t from, std::uint32_t what) {
    if (nodes_[from].stack <= nodes_[what].stack) return add_node(OP_DIFFERENCE, from, what);
    return add_node(OP_REVERSE_DIFFERENCE, what, from);
}

/// Joins all members under one operator. The members with the smallest stacks are joined first. So the path to each
/// member is short. Only two equal stacks make a stack that is one entry larger, so no tree of n leaves needs more than
/// log2(n) entries.
std::uint32_t Linearizer::join(std::uint32_t op, const List& list) {
    using Member = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  // stack, order of arrival, node
    std::priority_queue<Member, std::vector<Member>, std::greater<>> members;
    std::uint32_t came = 0;
    for (std::uint32_t cell = list.first; cell != none; cell = cells_[cell].next)
        members.emplace(nodes_[cells_[cell].node].stack, came++, cells_[cell].node);
    for (;;) {
        const std::uint32_t first = std::get<2>(members.top());
        members.pop();
        if (members.empty()) return first;
        const std::uint32_t second = std::get<2>(members.top());
        members.pop();
        const std::uint32_t node = add_node(op, first, second);
        members.emplace(nodes_[node].stack, came++, node);
    }
}

std::uint32_t Linearizer::finish(const Operand& operand) {
    if (is_single(operand)) return cells_[operand.p.first].node;
    if (operand.kind == Kind::any) return join(OP_UNION, operand.p);
    if (operand.kind == Kind::odd) return join(OP_XOR, operand.p);
    const std::uint32_t all = join(OP_INTERSECTION, operand.p);
    return operand.n.empty() ? all : add_difference(all, join(OP_UNION, operand.n));
}

/// The intersection of the operands from `first` on, each perhaps complemented.
Linearizer::Operand Linearizer::conjunction(std::size_t first) {
    Operand result{Kind::all, {}, {}, false};
    for (std::size_t i = first; i < operands_.size(); ++i) {
        const Operand& x = operands_[i];
        if (!x.complement && x.kind == Kind::all) {
            splice(result.p, x.p);
            splice(result.n, x.n);
        } else if (x.complement && (x.kind == Kind::any || is_single(x))) {
            splice(result.n, x.p);
        } else {
            append(x.complement ? result.n : result.p, finish(x));
        }
    }
    if (result.p.empty()) return {Kind::any, result.n, {}, true};
    return result;
}

Linearizer::Operand Linearizer::parity(std::size_t first) {
    Operand result{Kind::odd, {}, {}, false};
    for (std::size_t i = first; i < operands_.size(); ++i) {
        const Operand& x = operands_[i];
        if (x.complement) result.complement = !result.complement;
        if (x.kind == Kind::odd) {
            splice(result.p, x.p);
        } else {
            append(result.p, finish(x));
        }
    }
    return result;
}

std::uint32_t Linearizer::build(const FlatTree& tree) {
    nodes_.reserve(2 * tree.nodes.size());
    for (const FlatTree::Node& node : tree.nodes) {
        if (node.op == Operator::leaf) {
            Operand leaf{Kind::all, {}, {}, false};
            append(leaf.p, add_leaf(node.solid));
            operands_.push_back(leaf);
            continue;
        }
        if (node.op == Operator::not_) {
            operands_.back().complement = !operands_.back().complement;
            continue;
        }
        const std::size_t first = operands_.size() - node.arity;
        const auto complement_from = [&](std::size_t begin) {
            for (std::size_t i = begin; i < operands_.size(); ++i) operands_[i].complement = !operands_[i].complement;
        };
        Operand result;
        switch (node.op) {
            case Operator::union_:
                complement_from(first);
                result = conjunction(first);
                result.complement = !result.complement;
                break;
            case Operator::difference:
                complement_from(first + 1);
                result = conjunction(first);
                break;
            case Operator::xor_:
                result = parity(first);
                break;
            default:
                result = conjunction(first);
                break;  // an intersection
        }
        operands_.resize(first, result);
        operands_.push_back(result);
    }
    return finish(operands_.back());
}

LinearTree Linearizer::write(std::uint32_t root, std::vector<std::uint32_t>& words) const {
    LinearTree result;
    result.first_word = static_cast<std::uint32_t>(words.size());
    result.stack = nodes_[root].stack;
    struct Task {
        std::uint32_t node, parent;  // parent: the word that gets this node's position
    };
    std::vector<Task> tasks{{root, none}};
    while (!tasks.empty()) {
        const auto [number, parent] = tasks.back();
        tasks.pop_back();
        const Node& node = nodes_[number];
        const auto position = static_cast<std::uint32_t>(words.size());
        const std::uint32_t largest = node.op == OP_LEAF ? std::max(node.left, position) : position;
        check_tree_words(std::uint64_t{largest} + 1);
        if (parent != none) words[parent] |= position;
        if (node.op == OP_LEAF) {
            words.push_back(OP_LEAF << TREE_SHIFT | node.left);
            continue;
        }
        words.push_back(node.op << TREE_SHIFT);
        tasks.push_back({node.right, position});
        tasks.push_back({node.left, none});
    }
    result.word_count = static_cast<std::uint32_t>(words.size()) - result.first_word;
    return result;
}

}  // namespace

LinearTree linearize(const FlatTree& tree, std::vector<std::uint32_t>& words) {
    if (tree.nodes.empty()) return {static_cast<std::uint32_t>(words.size()), 0, 0};
    Linearizer linearizer;
    const std::uint32_t root = linearizer.build(tree);
    return linearizer.write(root, words);
}

}  // namespace csgrt
