#include "scene/edit_scene.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "scene/names.hpp"
#include "scene/object_path.hpp"
#include "scene/operators.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& suggestion = {}) {
    throw Error(Status::usage, {Diagnostic{.message = what, .suggestion = suggestion}});
}

constexpr const char* lead_to_it = "give the path that leads to it";

/// The objects along a path that ends with a member.
ObjectPath follow_to_member(const Scene& scene, const Names& names, const std::string& path) {
    ObjectPath found = follow_path(scene, names, path);
    // A path of one name does not tell the combination whose member the object is.
    if (found.steps.size() < 2) refuse("'" + path + "' is no leg of a combination", lead_to_it);
    return found;
}

Tree& tree_of(Scene& scene, std::uint32_t object) { return std::get<Combination>(scene.objects[object]).tree; }

/// "name~2", or with a higher number: a name that no object has, and none of `taken`.
std::string free_name(const std::string& like, const Names& names, const std::unordered_set<std::string>& taken = {}) {
    std::string name;
    for (std::uint32_t number = 2; name.empty() || names.find(name) != Names::none || taken.contains(name);)
        name = like + "~" + std::to_string(number++);
    return name;
}

/// For each object, the number of members that name it.
std::vector<std::uint32_t> users_of(const Scene& scene, const Names& names) {
    std::vector<std::uint32_t> users(scene.objects.size());
    for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
        const std::span<const std::uint32_t> children = names.children(object);
        for (std::uint32_t node = 0; node < children.size(); ++node) {
            std::uint32_t child = children[node];
            if (child == Names::left_out) child = names.find(names.node(object, node).object);
            if (child < Names::left_out) ++users[child];
        }
    }
    return users;
}

/// Copies combinations that an instance shares with other instances, so that an edit changes this instance only.
class Unsharer {
public:
    Unsharer(Scene& scene, const Names& names, const std::vector<std::string>& rendered)
        : scene_(scene), names_(names), users_(users_of(scene, names)), is_rendered_(scene.objects.size()) {
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
        copy.name = free_name(copy.name, names_, taken_);
        taken_.insert(copy.name);
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

std::size_t position(const std::vector<std::string>& rendered, const std::string& path) {
    return static_cast<std::size_t>(std::ranges::find(rendered, bare_path(path), bare_path) - rendered.begin());
}

void add_top(Scene& scene, const std::string& object, const Matrix& matrix) {
    if (scene.top.empty()) scene.top = top_objects(scene);
    const std::size_t number = position(scene.top, object);
    if (number == scene.top.size()) scene.top.push_back(object);
    if (scene.top_matrices.empty() && matrix == identity) return;
    scene.top_matrices.resize(scene.top.size(), identity);
    scene.top_matrices[number] = matrix;
}

void remove_top(Scene& scene, const std::string& object) {
    const std::size_t number = position(scene.top, object);
    if (number == scene.top.size()) return;
    scene.top.erase(scene.top.begin() + static_cast<std::ptrdiff_t>(number));
    if (number < scene.top_matrices.size())
        scene.top_matrices.erase(scene.top_matrices.begin() + static_cast<std::ptrdiff_t>(number));
}

namespace {

/// Gives the last member of a path, or its top object, another matrix. Changes the steps.
void place(Scene& scene, const Names& names, const std::vector<std::string>& rendered, const std::string& path,
           std::vector<ObjectPath::Step>& steps, const Matrix& matrix, bool alone) {
    if (steps.size() == 1) {
        if (position(rendered, path) == rendered.size())
            refuse("'" + path + "' is neither rendered by this name nor a leg of a combination", lead_to_it);
        return add_top(scene, name_of(scene.objects[steps[0].object]), matrix);
    }
    if (alone) Unsharer(scene, names, rendered).unshare(steps);
    tree_of(scene, steps[steps.size() - 2].object).nodes[steps.back().node].matrix = matrix;
}

/// Removes leaves of a tree; `leaves` ascend.
void remove_leaves(Scene& scene, const Names& names, std::uint32_t parent, const std::vector<std::uint32_t>& leaves) {
    Tree& tree = tree_of(scene, parent);
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i)  // numbered names of other leaves must not change
        if (tree.nodes[i].op == Operator::leaf && names.member_name(parent, i) != tree.nodes[i].object)
            tree.nodes[i].name = names.member_name(parent, i);
    for (auto leaf = leaves.rbegin(); leaf != leaves.rend(); ++leaf) remove_leaf(tree, *leaf);
}

/// Whether a path is among the `rendered` objects, once, and its object can have a place in Scene::top_matrices.
bool is_top(const Names& names, const std::vector<std::string>& rendered, const std::string& path) {
    const Scene& scene = names.scene();
    const auto is_name = [&](const std::string& top) { return names.find(top) != Names::none; };
    return std::ranges::count(rendered, bare_path(path), bare_path) == 1 && names.taken().empty() &&
           std::ranges::count(scene.top, bare_path(path), bare_path) < 2 &&
           (!scene.top_matrices.empty() || std::ranges::all_of(scene.top, is_name));
}

/// The objects along a path that ends with a member, or is a top object's name. No steps: it is neither, or it leads
/// through a removed member, whose name may lead to another member now.
ObjectPath find_member(const Names& names, const std::vector<std::string>& rendered, const std::string& path,
                       const SceneChanges& changes) {
    ObjectPath found = find_path(names.scene(), names, path);
    const std::vector<ObjectPath::Step>& steps = found.steps;
    bool is_there = steps.size() > 1 || is_top(names, rendered, path);
    for (std::size_t i = 1; i < steps.size(); ++i)
        is_there = is_there && !changes.removed.contains({steps[i - 1].object, steps[i].node});
    if (!is_there) found.steps.clear();
    return found;
}

/// The first combination on the way to the last member of a path that has other instances. All below it have some, too.
/// The number of the last step: an edit of this member changes this instance alone.
std::size_t first_shared(const Names& names, const std::vector<std::string>& rendered,
                         const std::vector<ObjectPath::Step>& steps) {
    std::size_t end = steps.size() - 1;
    if (end == 0) return end;
    const std::vector<std::uint32_t> users = users_of(names.scene(), names);
    if (users[steps.front().object] > 0) return 0;
    for (std::size_t i = 1; i < end; ++i)
        if (users[steps[i].object] > 1) end = i;
    for (const std::string& root : rendered)
        if (const ObjectPath other = find_path(names.scene(), names, root); !other.steps.empty())
            for (std::size_t i = 1; i < end; ++i)
                if (steps[i].object == other.object()) end = i;
    return end;
}

/// Whether a combination may have a copy: the matrix of an instance below it changes alone.
bool may_have_copy(std::uint32_t object, const SceneChanges& changes) {
    const auto is_it = [&](const Member& member) { return member.first == object; };
    return std::ranges::any_of(changes.matrices.alone,
                               [&](const auto& entry) { return std::ranges::any_of(entry.first, is_it); });
}

/// The last member of the steps of a path, or its top object.
Member member_of(const std::vector<ObjectPath::Step>& steps) {
    if (steps.size() == 1) return {steps[0].object, Names::none};
    return {steps[steps.size() - 2].object, steps.back().node};
}

/// The matrix of a path's last step that makes its placement `matrix` times the present placement. Nothing: a matrix
/// above it cannot be inverted.
std::optional<Matrix> moved_matrix(const Names& names, const ObjectPath& path, const Matrix& matrix,
                                   const MemberMatrices& moved) {
    const std::size_t last = path.steps.size() - 1;
    const Matrix whole = compose(matrix, placement_of(names, path, last, moved));
    return last == 0 ? whole : divide(placement_of(names, path, last - 1, moved), whole);
}

}  // namespace

void place_object(Scene& scene, const std::vector<std::string>& rendered, const std::string& path, const Matrix& matrix,
                  bool alone) {
    const Names names(scene);
    ObjectPath found = follow_path(scene, names, path);
    place(scene, names, rendered, path, found.steps, matrix, alone);
}

void move_object(Scene& scene, const std::vector<std::string>& rendered, const std::string& path, const Matrix& matrix,
                 bool alone) {
    const Names names(scene);
    ObjectPath found = follow_path(scene, names, path);
    const std::optional<Matrix> own = moved_matrix(names, found, matrix, {});
    if (!own)
        refuse("a matrix above '" + path + "' cannot be inverted, so that nothing below it can be moved",
               "give that part another matrix first (set_matrix)");
    place(scene, names, rendered, path, found.steps, *own, alone);
}

void remove_member(Scene& scene, const std::string& path) {
    const Names names(scene);
    const std::vector<ObjectPath::Step> steps = follow_to_member(scene, names, path).steps;
    remove_leaves(scene, names, steps[steps.size() - 2].object, {steps.back().node});
}

Scene changed_scene(const Scene& scene, const SceneChanges& changes, const std::vector<std::string>& objects) {
    Scene changed = scene;
    for (const auto& [member, matrix] : changes.matrices.all)
        if (member.second == Names::none) {
            add_top(changed, name_of(scene.objects[member.first]), matrix);
        } else {
            tree_of(changed, member.first).nodes[member.second].matrix = matrix;
        }
    if (!changes.matrices.alone.empty() && changed.top.empty()) changed.top = top_objects(changed);  // no copy is one
    for (const auto& [members, matrix] : changes.matrices.alone) {
        const Names names(changed);
        std::vector<ObjectPath::Step> steps{{members.front().first, 0}};
        for (const Member& member : members)
            steps.push_back({names.child(steps.back().object, member.second), member.second});
        place(changed, names, objects.empty() ? changed.top : objects, {}, steps, matrix, true);
    }
    if (changes.removed.empty()) return changed;
    const Names names(scene);
    if (changed.top.empty()) changed.top = names.top_objects();  // a removed object does not become a top object
    std::map<std::uint32_t, std::vector<std::uint32_t>> leaves;
    for (const auto& [parent, leaf] : changes.removed) leaves[parent].push_back(leaf);
    for (const auto& [parent, of] : leaves) remove_leaves(changed, names, parent, of);
    return changed;
}

namespace {

bool put_beside(const Names& names, const std::vector<std::string>& rendered, const ObjectPath& path,
                const Matrix& matrix, bool alone, SceneChanges& changes) {
    const std::vector<ObjectPath::Step>& steps = path.steps;
    const Member member = member_of(steps);
    const std::size_t last = steps.size() - 1, shared = first_shared(names, rendered, steps);
    if (alone && shared < last) {
        for (std::size_t i = 0; i < last; ++i) {
            const auto removed = changes.removed.lower_bound({steps[i].object, 0});
            const bool has_removed = removed != changes.removed.end() && removed->first == steps[i].object;
            if (names.kind(steps[i].object) != Names::Kind::combination || (has_removed && i >= shared)) return false;
        }
        changes.matrices.alone[member_path(path, last)] = matrix;
    } else {
        if (shared < last && may_have_copy(member.first, changes)) return false;
        changes.matrices.all[member] = matrix;
    }
    return true;
}

}  // namespace

bool place_beside(const Names& names, const std::vector<std::string>& rendered, const std::string& path,
                  const Matrix& matrix, bool alone, SceneChanges& changes) {
    const ObjectPath found = find_member(names, rendered, path, changes);
    return !found.steps.empty() && put_beside(names, rendered, found, matrix, alone, changes);
}

bool move_beside(const Names& names, const std::vector<std::string>& rendered, const std::string& path,
                 const Matrix& matrix, bool alone, SceneChanges& changes) {
    const ObjectPath found = find_member(names, rendered, path, changes);
    if (found.steps.empty()) return false;
    const std::optional<Matrix> own = moved_matrix(names, found, matrix, changes.matrices);
    return own && put_beside(names, rendered, found, *own, alone, changes);
}

bool remove_beside(const Names& names, const std::vector<std::string>& rendered, const std::string& path,
                   SceneChanges& changes) {
    const std::vector<ObjectPath::Step> steps = find_member(names, rendered, path, changes).steps;
    if (steps.size() < 2) return false;
    const auto [parent, leaf] = member_of(steps);
    for (const std::string& root : rendered) {
        const std::vector<ObjectPath::Step> other = find_path(names.scene(), names, root).steps;
        for (std::size_t i = 1; i < other.size(); ++i)
            if (other[i - 1].object == parent && other[i].node == leaf) return false;  // a root would lead nowhere
    }
    const std::vector<TreeNode>& nodes = std::get<Combination>(names.scene().objects[parent]).tree.nodes;
    const auto removed =
        std::distance(changes.removed.lower_bound({parent, 0}), changes.removed.lower_bound({parent + 1, 0}));
    const std::size_t operands = nodes.size() - 1, left = operands - static_cast<std::size_t>(removed);
    const bool is_union = nodes.back().op == Operator::union_ && nodes.back().arity == operands;
    if (!is_union || left < 2 || may_have_copy(parent, changes)) return false;
    changes.removed.insert({parent, leaf});
    return true;
}

void add_member(Scene& scene, const std::string& path, Operator op, const std::string& object, const Matrix& matrix) {
    const Names names(scene);
    const std::uint32_t parent = follow_path(scene, names, path).object();
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

void replace_shape(Scene& scene, const std::string& path, Shape shape, const Matrix& matrix) {
    const Names names(scene);
    std::uint32_t object = follow_path(scene, names, path).object();
    const std::string name = name_of(scene.objects[object]);
    if (auto* around = std::get_if<Combination>(&scene.objects[object])) {
        std::vector<TreeNode>& nodes = around->tree.nodes;
        const bool is_moved_solid = nodes.size() == 1 && nodes[0].object.starts_with(name + "~");
        if (!is_moved_solid || !names.is_solid(names.child(object, 0)))
            refuse("'" + path + "' is a combination: it has no numbers of its own");
        nodes[0].matrix = matrix;
        object = names.child(object, 0);
    } else if (matrix != identity) {
        // A region, so that paths stay where no region is around it.
        Solid moved{free_name(name, names), {}, place_of(scene.objects[object])};
        scene.objects[object] = Combination{.name = name,
                                            .tree = tree(moved.name, matrix),
                                            .region = true,
                                            .material_id = 0,
                                            .los = 0,
                                            .place = moved.place};
        object = static_cast<std::uint32_t>(scene.objects.size());
        scene.objects.emplace_back(std::move(moved));
    }
    std::get<Solid>(scene.objects[object]).shape = std::move(shape);
}

void erase_object(Scene& scene, const std::vector<std::string>& rendered, const std::string& path) {
    std::optional<Names> names(scene);
    const ObjectPath found = follow_path(scene, *names, path);
    const std::uint32_t object = found.object();
    const bool is_member = found.steps.size() > 1;
    std::vector<std::uint32_t> uses(scene.objects.size());
    std::string users;
    const auto use = [&](std::uint32_t used, const std::string& user) {
        ++uses[used];
        if (used == object) users += (users.empty() ? "" : ", ") + user;
    };
    for (std::uint32_t user = 0; user < scene.objects.size(); ++user) {
        const std::span<const std::uint32_t> children = names->children(user);
        for (std::uint32_t node = 0; node < children.size(); ++node) {
            const bool is_it =
                is_member && node == found.steps.back().node && user == found.steps[found.steps.size() - 2].object;
            if (children[node] < Names::left_out && !is_it)
                use(children[node], "'" + name_of(scene.objects[user]) + "'");
        }
    }
    for (const std::vector<std::string>* roots : {&rendered, &std::as_const(scene.top)})
        for (const std::string& root : *roots)
            if (bare_path(root) != bare_path(path))
                for (const ObjectPath::Step& step : find_path(scene, *names, root).steps)
                    use(step.object, "the list of what is rendered");
    if (!users.empty())
        refuse("'" + name_of(scene.objects[object]) + "' has other uses: " + users,
               "remove() takes it away here alone, and leaves the object");
    std::vector<bool> is_gone(scene.objects.size());
    for (std::vector<std::uint32_t> gone{object}; !gone.empty();) {
        const std::uint32_t next = gone.back();
        gone.pop_back();
        is_gone[next] = true;
        remove_top(scene, name_of(scene.objects[next]));
        for (const std::uint32_t child : names->children(next))
            if (child < Names::left_out && --uses[child] == 0) gone.push_back(child);
    }
    names.reset();
    if (is_member) remove_member(scene, path);
    std::erase_if(scene.objects, [&, i = std::size_t{0}](const Object&) mutable { return is_gone[i++]; });
}

}  // namespace csgrt
