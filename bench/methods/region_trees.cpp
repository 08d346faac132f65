#include "region_trees.hpp"

#include <algorithm>

namespace csgrt::bench {

RegionTrees::RegionTrees(const CompiledScene& scene, bool planted) : leaves_(scene.solids.size()) {
    std::vector<Operand> stack;
    for (const FlatTree& tree : scene.flat_trees) {
        stack.clear();
        for (const FlatTree::Node& node : tree.nodes) {
            if (node.op == Operator::leaf) {
                const auto index = static_cast<std::uint32_t>(nodes_.size());
                nodes_.push_back({Gate::leaf, EMPTY_SET, EMPTY_SET, NONE, region_});
                leaves_[node.solid].push_back(index);
                stack.push_back(index << 1);
                continue;
            }
            const std::size_t first = stack.size() - node.arity;
            const Operand* operands = stack.data() + first;
            Operand result = EMPTY_SET;
            switch (node.op) {
                case Operator::intersection:
                    result = balanced(Gate::intersection, operands, node.arity);
                    break;
                case Operator::xor_:
                    result = balanced(Gate::xor_, operands, node.arity);
                    break;
                case Operator::not_:
                    result = operands[0] ^ 1;
                    break;
                case Operator::difference:
                    if (!planted) {
                        result = add(Gate::intersection, operands[0],
                                     balanced(Gate::union_, operands + 1, node.arity - 1) ^ 1);
                        break;
                    }
                    [[fallthrough]];
                default:
                    result = balanced(Gate::union_, operands, node.arity);
            }
            stack.resize(first);
            stack.push_back(result);
        }
        roots_.push_back(stack.empty() ? EMPTY_SET : stack.back());
        ++region_;
    }
}

Operand RegionTrees::add(Gate gate, Operand left, Operand right) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({gate, left, right, NONE, region_});
    nodes_[left >> 1].parent = nodes_[right >> 1].parent = index;
    return index << 1;
}

Operand RegionTrees::balanced(Gate gate, const Operand* operands, std::size_t count) {
    if (count == 1) return operands[0];
    const Operand left = balanced(gate, operands, count / 2);
    return add(gate, left, balanced(gate, operands + count / 2, count - count / 2));
}

LiveTrees::LiveTrees(const RegionTrees& trees)
    : trees_(trees), seen_(trees.nodes().size()), live_(trees.nodes().size()), candidate_of_(trees.nodes().size()) {}

Operand LiveTrees::live(Operand operand) const {
    return (seen_[operand >> 1] == ray_ ? live_[operand >> 1] : EMPTY_SET) ^ (operand & 1);
}

void LiveTrees::build(const std::vector<std::uint32_t>& candidates) {
    ++ray_;
    alive_.clear();
    nodes_.clear();
    roots_.clear();
    const std::vector<RegionTrees::Node>& all = trees_.nodes();
    for (std::uint32_t i = 0; i < candidates.size(); ++i)
        for (const std::uint32_t leaf : trees_.leaves_of(candidates[i])) {
            candidate_of_[leaf] = i;
            for (std::uint32_t node = leaf; node != NONE && seen_[node] != ray_; node = all[node].parent) {
                seen_[node] = ray_;
                alive_.push_back(node);
            }
        }
    std::sort(alive_.begin(), alive_.end());
    std::uint32_t first = 0;
    for (const std::uint32_t index : alive_) {
        const RegionTrees::Node& node = all[index];
        const auto next = static_cast<std::uint32_t>(nodes_.size());
        if (node.gate == Gate::leaf) {
            nodes_.push_back({Gate::leaf, EMPTY_SET, EMPTY_SET, candidate_of_[index]});
            live_[index] = next << 1;
        } else {
            const Operand a = live(node.left), b = live(node.right);
            const bool a_set = a >= EMPTY_SET, b_set = b >= EMPTY_SET;
            if (a_set || b_set) {
                const Operand set = a_set ? a : b, other = a_set ? b : a;
                const Operand absorbing = node.gate == Gate::union_ ? FULL_SET : EMPTY_SET;
                live_[index] = node.gate == Gate::xor_ ? other ^ (set & 1) : set == absorbing ? set : other;
            } else {
                nodes_.push_back({node.gate, a, b, 0});
                live_[index] = next << 1;
            }
        }
        if (node.parent != NONE) continue;
        const Operand root = live(trees_.root(node.region));
        const auto last = static_cast<std::uint32_t>(nodes_.size());
        if (root != EMPTY_SET) roots_.push_back({node.region, root, first, last});
        first = last;
    }
}

}  // namespace csgrt::bench
