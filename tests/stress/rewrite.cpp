// Trees are in postfix order and may be 10^5 nodes deep: every pass is a loop.
#include "rewrite.hpp"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace csgrt::stress {
namespace {

TreeNode node_of(Operator op, std::uint32_t arity) { return {op, arity, {}, identity, {}}; }

constexpr std::size_t none = static_cast<std::size_t>(-1);

/// For every node its parent, and which of the parent's operands it is.
struct Above {
    std::size_t parent = none, operand = 0;
};
std::vector<Above> parents(const Tree& tree) {
    std::vector<Above> above(tree.nodes.size());
    std::vector<std::size_t> stack;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        const std::size_t first = stack.size() - tree.nodes[i].arity;
        for (std::size_t k = first; k < stack.size(); ++k) above[stack[k]] = {i, k - first};
        stack.resize(first);
        stack.push_back(i);
    }
    return above;
}

/// In reverse postfix order a node comes before its operands, the last one first; taken the other way round, the
/// operands come out in reverse.
Tree commuted(const Tree& tree) {
    std::vector<std::vector<std::size_t>> operands(tree.nodes.size());
    const std::vector<Above> above = parents(tree);
    for (std::size_t i = 0; i < tree.nodes.size(); ++i)
        if (above[i].parent != none) operands[above[i].parent].push_back(i);
    Tree result;
    std::vector<std::size_t> stack{tree.nodes.size() - 1};
    while (!stack.empty()) {
        const std::size_t i = stack.back();
        stack.pop_back();
        result.nodes.push_back(tree.nodes[i]);
        // What is pushed last comes next in `result`, and so last when that is turned around.
        std::vector<std::size_t>& list = operands[i];
        const auto from = list.begin() + (tree.nodes[i].op == Operator::difference ? 1 : 0);
        std::reverse(from, list.end());
        stack.insert(stack.end(), list.begin(), list.end());
    }
    std::reverse(result.nodes.begin(), result.nodes.end());
    return result;
}

}  // namespace

Tree rewritten(const Tree& tree, Rewriting how) {
    if (tree.nodes.empty()) return tree;
    if (how == Rewriting::commuted) return commuted(tree);
    const std::vector<Above> above = parents(tree);
    Tree result;
    const auto add = [&](Operator op, std::uint32_t arity) { result.nodes.push_back(node_of(op, arity)); };
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        const TreeNode& node = tree.nodes[i];
        const bool set = node.op == Operator::union_ || node.op == Operator::intersection;
        if (how == Rewriting::differences && node.op == Operator::difference) {
            add(Operator::intersection, node.arity);
        } else if (how == Rewriting::de_morgan && (set || node.op == Operator::difference)) {
            add(node.op == Operator::union_ ? Operator::intersection : Operator::union_, node.arity);
            add(Operator::not_, 1);
        } else {
            result.nodes.push_back(node);
        }
        if (how == Rewriting::double_complements) {
            add(Operator::not_, 1);
            add(Operator::not_, 1);
        }
        if (above[i].parent == none) continue;
        const Operator parent = tree.nodes[above[i].parent].op;
        const bool first = above[i].operand == 0;
        const bool complement = how == Rewriting::differences ? parent == Operator::difference && !first
                                : how == Rewriting::de_morgan
                                    ? parent == Operator::union_ || parent == Operator::intersection ||
                                          (parent == Operator::difference && first)
                                    : false;
        if (complement) add(Operator::not_, 1);
    }
    return result;
}

Scene rewritten(const Scene& scene, Rewriting how) {
    Scene result = scene;
    std::unordered_map<std::string, Combination*> by_name;
    std::vector<Combination*> todo;
    for (Object& object : result.objects)
        if (auto* combination = std::get_if<Combination>(&object)) {
            by_name[combination->name] = combination;
            if (combination->region) todo.push_back(combination);
        }
    std::unordered_set<const Combination*> done(todo.begin(), todo.end());
    while (!todo.empty()) {
        Combination& combination = *todo.back();
        todo.pop_back();
        for (const TreeNode& node : combination.tree.nodes) {
            if (node.op != Operator::leaf) continue;
            const auto below = by_name.find(node.object);
            if (below != by_name.end() && done.insert(below->second).second) todo.push_back(below->second);
        }
        combination.tree = rewritten(combination.tree, how);
    }
    return result;
}

Scene moved(const Scene& scene, const std::vector<std::string>& objects, const Matrix& matrix) {
    Scene result = scene;
    Combination group;
    group.name = "moved";
    for (const std::string& object : objects) group.tree.nodes.push_back({Operator::leaf, 0, object, matrix, {}});
    if (objects.size() > 1)
        group.tree.nodes.push_back(node_of(Operator::union_, static_cast<std::uint32_t>(objects.size())));
    result.objects.push_back(std::move(group));
    result.top = {"moved"};
    return result;
}

}  // namespace csgrt::stress
