#include "scene/edit_scene.hpp"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "scene/names.hpp"
#include "scene/object_path.hpp"
#include "scene/operators.hpp"

namespace csgrt {

namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& suggestion = {}) {
    throw Error(Status::usage, {Diagnostic{.message = what, .suggestion = suggestion}});
}

/// The objects along a path. `least`: the least number of parts that the path must have.
ObjectPath follow(const Scene& scene, const Names& names, const std::string& path, std::size_t least = 1) {
    ObjectPath found = find_path(scene, names, path);
    if (found.steps.empty()) refuse(found.fault, found.suggestion);
    // The path is one name, so it does not tell the combination whose member the object is.
    if (found.steps.size() < least) refuse("'" + path + "' is no leg of a combination: give the path that leads to it");
    return found;
}

Tree& tree_of(Scene& scene, std::uint32_t object) { return std::get<Combination>(scene.objects[object]).tree; }

/// Copies combinations that an instance shares with other instances, so that an edit changes this instance only.
class Unsharer {
public:
    Unsharer(Scene& scene, const Names& names, const std::vector<std::string>& rendered)
        : scene_(scene), names_(names), users_(scene.objects.size()), is_rendered_(scene.objects.size()) {
        for (std::uint32_t object = 0; object < scene.objects.size(); ++object)
            for (const std::uint32_t child : names.children(object))
                if (child < Names::left_out) ++users_[child];
        for (const std::string& root : rendered)
            if (const ObjectPath path = find_path(scene, names, root); !path.steps.empty())
                is_rendered_[path.object()] = true;
    }

    /// Makes the path's combinations, except the last step's object, belong to this instance only. Changes the steps.
    void unshare(std::vector<ObjectPath::Step>& steps) {
        if (users_[steps.front().object] > 0) give_others_a_copy(steps.front().object);
        for (std::size_t i = 1; i + 1 < steps.size(); ++i) {
            const std::uint32_t object = steps[i].object;
            if (users_[object] < 2 && !is_rendered_[object]) continue;
            const std::uint32_t copy = copied(object);
            lead_to(steps[i - 1].object, steps[i].node, copy);
            --users_[object];
            users_[copy] = 1;
            steps[i].object = copy;
        }
    }

private:
    /// Makes all members that name the object name a copy instead. The object itself stays at the begin of paths.
    void give_others_a_copy(std::uint32_t object) {
        const std::uint32_t copy = copied(object);
        for (std::uint32_t user = 0; user < scene_.objects.size(); ++user) {
            const auto* combination = std::get_if<Combination>(&scene_.objects[user]);
            if (combination == nullptr) continue;
            for (std::uint32_t node = 0; node < combination->tree.nodes.size(); ++node)
                if (child(user, node) == object) lead_to(user, node, copy);
        }
        users_[copy] = std::exchange(users_[object], 0);
    }

    /// The object from which `object` was copied, or `object` itself.
    std::uint32_t original(std::uint32_t object) const {
        const std::size_t count = scene_.objects.size() - origin_.size();
        return object < count ? object : origin_[object - count];
    }
    std::uint32_t child(std::uint32_t object, std::uint32_t node) const { return names_.child(original(object), node); }

    std::uint32_t copied(std::uint32_t object) {
        Combination copy = std::get<Combination>(scene_.objects[object]);
        std::string name;
        for (std::uint32_t number = 2; name.empty() || names_.find(name) != Names::none || taken_.contains(name);)
            name = copy.name + "~" + std::to_string(number++);
        taken_.insert(name);
        copy.name = std::move(name);
        for (std::uint32_t node = 0; node < copy.tree.nodes.size(); ++node) {
            const std::uint32_t below = child(object, node);
            if (below < Names::left_out) ++users_[below];
        }
        const std::uint32_t from = original(object);
        scene_.objects.emplace_back(std::move(copy));
        origin_.push_back(from);
        users_.push_back(0);
        is_rendered_.push_back(false);
        return static_cast<std::uint32_t>(scene_.objects.size() - 1);
    }

    /// Makes a member name another object under the member's old name.
    void lead_to(std::uint32_t user, std::uint32_t node, std::uint32_t object) {
        TreeNode& member = tree_of(scene_, user).nodes[node];
        if (member.name.empty()) member.name = names_.member_name(original(user), node);
        member.object = name_of(scene_.objects[object]);
    }

    Scene& scene_;
    const Names& names_;                ///< names of the scene before copies were made
    std::vector<std::uint32_t> users_;  ///< for each object: the number of members that name it
    std::vector<bool> is_rendered_;
    std::vector<std::uint32_t> origin_;  ///< for each copy, which are the last objects: its original
    std::unordered_set<std::string> taken_;
};

/// Removes a leaf from the tree.
void remove_leaf(Tree& tree, std::uint32_t leaf) {
    struct Operand {
        std::size_t first;  ///< index of the node in the new tree
        bool is_gone;
    };
    std::vector<TreeNode> kept;
    std::vector<Operand> operands;
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        TreeNode& node = tree.nodes[i];
        if (node.op == Operator::leaf) {
            operands.push_back({kept.size(), i == leaf});
            if (i != leaf) kept.push_back(std::move(node));
            continue;
        }
        const auto first = operands.end() - node.arity;
        const auto gone = std::count_if(first, operands.end(), [](const Operand& o) { return o.is_gone; });
        Operand result{first->first, gone == std::ptrdiff_t{node.arity}};
        if (gone > 0 && node.op == Operator::difference && first->is_gone) {
            kept.resize(result.first);
            result.is_gone = true;
        }
        node.arity -= static_cast<std::uint32_t>(gone);
        const bool has_operator = node.op == Operator::not_ || gone == 0 || node.arity > 1;
        if (!result.is_gone && has_operator) kept.push_back(std::move(node));
        operands.erase(first, operands.end());
        operands.push_back(result);
    }
    tree.nodes = std::move(kept);
}

}  // namespace

void set_member_matrix(Scene& scene, const std::vector<std::string>& rendered, const std::string& path,
                       const Matrix& matrix, bool alone) {
    const Names names(scene);
    std::vector<ObjectPath::Step> steps = follow(scene, names, path, 2).steps;
    if (alone) Unsharer(scene, names, rendered).unshare(steps);
    tree_of(scene, steps[steps.size() - 2].object).nodes[steps.back().node].matrix = matrix;
}

void remove_member(Scene& scene, const std::string& path) {
    const Names names(scene);
    const std::vector<ObjectPath::Step> steps = follow(scene, names, path, 2).steps;
    const std::uint32_t parent = steps[steps.size() - 2].object, leaf = steps.back().node;
    Tree& tree = tree_of(scene, parent);
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i)  // numbered names of other leaves must not change
        if (tree.nodes[i].op == Operator::leaf && names.member_name(parent, i) != tree.nodes[i].object)
            tree.nodes[i].name = names.member_name(parent, i);
    remove_leaf(tree, leaf);
}

void add_member(Scene& scene, const std::string& path, Operator op, const std::string& object, const Matrix& matrix) {
    const Names names(scene);
    const std::uint32_t parent = follow(scene, names, path).object();
    if (names.is_solid(parent)) refuse("'" + path + "' is a solid: it has no legs");
    if (op == Operator::leaf || op == Operator::not_) refuse("a leg is added by an operator of two operands");
    if (names.find(object) == Names::none)
        refuse("the scene has no object '" + object + "'", did_you_mean_object(scene, object));
    std::vector<TreeNode>& nodes = tree_of(scene, parent).nodes;
    if (nodes.empty() && op != Operator::union_ && op != Operator::xor_)
        refuse("'" + path + "' is empty: a leg can be united with it alone");
    TreeNode member{.op = Operator::leaf, .object = object, .matrix = matrix};
    if (!nodes.empty() && nodes.back().op == op) {
        ++nodes.back().arity;
        nodes.insert(nodes.end() - 1, std::move(member));
    } else {
        nodes.push_back(std::move(member));
        if (nodes.size() > 1) nodes.push_back({.op = op, .arity = 2});
    }
}

void replace_shape(Scene& scene, const std::string& path, Shape shape) {
    const Names names(scene);
    auto* solid = std::get_if<Solid>(&scene.objects[follow(scene, names, path).object()]);
    if (solid == nullptr) refuse("'" + path + "' is a combination: it has no numbers of its own");
    solid->shape = std::move(shape);
}

}  // namespace csgrt
