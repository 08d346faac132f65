// Goldfeather, Molnar, Turk, Fuchs 1989: "Near real-time CSG rendering using tree normalization and geometric pruning";
// thesis section 2.1.2 and figure 2.4, where the nine rules are called eight.
//
// Theory: a tree of unions, intersections and differences becomes a union of products by
//
//     1  x - (y + z)  ->  (x - y) - z              6  x * (y - z)  ->  (x * y) - z
//     2  x * (y + z)  ->  (x * y) + (x * z)        7  (x - y) * z  ->  (x * z) - y
//     3  x - (y * z)  ->  (x - y) + (x - z)        8  (x + y) - z  ->  (x - z) + (y - z)
//     4  x * (y * z)  ->  (x * y) * z              9  (x + y) * z  ->  (x * z) + (y * z)
//     5  x - (y - z)  ->  (x - y) + (x * z)
//
// A node takes the first rule that fits until none does; then its left operand is made normal, and so on until the node
// is a union, or its right operand a solid and its left one no union; then the right operand is made normal. A xor,
// which the rules do not know, is written as (x - y) + (y - x) before.
//
// Pruning by boxes: a product is left out if the boxes of its solids, but those that it subtracts, have no point in
// common.
//
// Cost: products may be exponentially many; after most_rules applications, or deeper than most_levels, it ends without
// a result. Prediction: on models as many products as solids, within a factor of two, of which boxes prune few, since
// parts of one region are near each other; xor and deep_trees do not end.
#include "depth_buffer.hpp"

namespace csgrt::bench {
namespace {

constexpr std::uint64_t most_rules = 200'000;
constexpr int most_levels = 2'000;

class Rewriter {
public:
    explicit Rewriter(const GeneralTree& tree) {
        for (const GeneralTree::Node& node : tree.nodes) {
            if (node.op != Operator::xor_) {
                const bool leaf = node.op == Operator::leaf;
                number_.push_back(make(node.op, leaf ? node.left : number_[node.left], leaf ? 0 : number_[node.right]));
                continue;
            }
            const std::uint32_t a = number_[node.left], b = number_[node.right];
            number_.push_back(
                make(Operator::union_, make(Operator::difference, a, b), make(Operator::difference, b, a)));
        }
        root_ = number_[tree.root.node];
    }

    /// False: it would not end.
    bool run() {
        root_ = normal(root_, 0);
        return ended_;
    }
    std::uint64_t applied() const { return applied_; }

    void for_products(const std::function<void(const Product&)>& each) const {
        std::vector<std::uint32_t> rest{root_};
        Product product;
        while (!rest.empty()) {
            std::uint32_t node = rest.back();
            rest.pop_back();
            if (nodes_[node].op == Operator::union_) {
                rest.insert(rest.end(), {nodes_[node].right, nodes_[node].left});
                continue;
            }
            product.clear();
            for (; nodes_[node].op != Operator::leaf; node = nodes_[node].left)
                product.push_back(nodes_[nodes_[node].right].left << 1 | (nodes_[node].op == Operator::difference));
            product.push_back(nodes_[node].left << 1);
            each(product);
        }
    }

private:
    std::uint32_t make(Operator op, std::uint32_t left, std::uint32_t right) {
        nodes_.push_back({op, left, right});
        is_normal_.push_back(op == Operator::leaf);
        return static_cast<std::uint32_t>(nodes_.size() - 1);
    }

    /// The node after the first rule that fits; itself, if none does.
    std::uint32_t apply(std::uint32_t number) {
        const GeneralTree::Node node = nodes_[number];
        if (node.op == Operator::union_) return number;
        const std::uint32_t a = node.left, b = node.right;
        const GeneralTree::Node left = nodes_[a], right = nodes_[b];
        constexpr Operator plus = Operator::union_, times = Operator::intersection, minus = Operator::difference;
        if (node.op == minus) {
            if (right.op == plus) return make(minus, make(minus, a, right.left), right.right);                  // 1
            if (right.op == times) return make(plus, make(minus, a, right.left), make(minus, a, right.right));  // 3
            if (right.op == minus) return make(plus, make(minus, a, right.left), make(times, a, right.right));  // 5
            if (left.op == plus) return make(plus, make(minus, left.left, b), make(minus, left.right, b));      // 8
            return number;
        }
        if (right.op == plus) return make(plus, make(times, a, right.left), make(times, a, right.right));  // 2
        if (right.op == times) return make(times, make(times, a, right.left), right.right);                // 4
        if (right.op == minus) return make(minus, make(times, a, right.left), right.right);                // 6
        if (left.op == minus) return make(minus, make(times, left.left, b), left.right);                   // 7
        if (left.op == plus) return make(plus, make(times, left.left, b), make(times, left.right, b));     // 9
        return number;
    }

    std::uint32_t normal(std::uint32_t number, int level) {
        if (is_normal_[number] || !ended_) return number;
        if (level > most_levels) ended_ = false;
        const auto is_done = [&] {
            const GeneralTree::Node& node = nodes_[number];
            return node.op == Operator::union_ ||
                   (nodes_[node.right].op == Operator::leaf && nodes_[node.left].op != Operator::union_);
        };
        do {
            for (std::uint32_t next; ended_ && (next = apply(number)) != number; number = next)
                ended_ = ++applied_ < most_rules;
            const GeneralTree::Node node = nodes_[number];
            const std::uint32_t left = ended_ ? normal(node.left, level + 1) : node.left;
            if (left != node.left) number = make(node.op, left, node.right);
        } while (ended_ && !is_done());
        const GeneralTree::Node node = nodes_[number];
        const std::uint32_t right = ended_ ? normal(node.right, level + 1) : node.right;
        if (right != node.right) number = make(node.op, node.left, right);
        is_normal_[number] = true;
        return number;
    }

    std::vector<GeneralTree::Node> nodes_;  ///< never changed: operands may be shared
    std::vector<bool> is_normal_;
    std::vector<std::uint32_t> number_;  ///< of the tree's nodes
    std::uint32_t root_ = 0;
    std::uint64_t applied_ = 0;
    bool ended_ = true;
};

}  // namespace

std::optional<std::uint64_t> rewrite(const GeneralTree& tree, const std::function<void(const Product&)>& each) {
    if (tree.root.complement) return {};
    if (tree.nodes.empty()) return 0;
    Rewriter rewriter(tree);
    if (!rewriter.run()) return {};
    rewriter.for_products(each);
    return rewriter.applied();
}

}  // namespace csgrt::bench
