// What is at a path of a Model: regions, places and trees.
#include <csgrt/model.hpp>

#include <utility>

#include "compile/flatten/solid_parts.hpp"
#include "compile/regions/path_table.hpp"
#include "render/model_impl.hpp"
#include "scene/object_path.hpp"
#include "scene/solids/placed.hpp"

namespace csgrt {

namespace {

/// The operator before each leaf of a tree, by the number of its node, as BRL-CAD lists them: the one that joins the
/// operand that begins with the leaf to the operands before it.
std::vector<Operator> joints(const std::vector<TreeNode>& nodes) {
    std::vector<Operator> joining(nodes.size(), Operator::leaf);
    std::vector<std::size_t> firsts;  // nodes with which the operands begin that wait
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].op == Operator::leaf) {
            firsts.push_back(i);
            continue;
        }
        if (nodes[i].arity == 0 || nodes[i].arity > firsts.size()) return {};  // a broken tree, which is left out
        const std::size_t base = firsts.size() - nodes[i].arity,
                          second = nodes[i].op == Operator::not_ ? base : base + 1;
        for (std::size_t k = second; k < firsts.size(); ++k)
            if (joining[firsts[k]] == Operator::leaf) joining[firsts[k]] = nodes[i].op;
        firsts.resize(base + 1);
    }
    for (Operator& op : joining)
        if (op == Operator::leaf) op = Operator::union_;
    return joining;
}

}  // namespace

const Names& Model::Impl::names() const {
    std::call_once(has_names_, [&] {
        const SceneChanges& changes = source.changes;
        // The name of a removed member may lead to another member now, so paths need a tree without removed members.
        // And copies of combinations have names of their own.
        const bool has_trees = changes.removed.empty() && changes.matrices.alone.empty();
        named_scene_ = has_trees ? source.scene
                                 : std::make_shared<const Scene>(changed_scene(*source.scene, changes, source.objects));
        names_.emplace(*named_scene_);
        if (has_trees) names_->set_matrices(changes.matrices);
    });
    return *names_;
}

std::int32_t Model::region(const std::string& path) const {
    const std::vector<std::uint32_t> found = regions(path);
    return found.empty() || regions()[found.front()].path != normal_path(path)
               ? -1
               : static_cast<std::int32_t>(found.front());
}

std::vector<std::uint32_t> Model::regions(const std::string& path) const {
    return LatePathTable::find(impl_->scene, normal_path(path));
}

std::optional<Shape> Model::solid(std::size_t index) const {
    const FloatingPoint own;
    const CompiledScene& scene = impl_->scene;
    if (index >= scene.solid_info.size())
        throw Error(Status::usage, "there is no solid " + std::to_string(index) + " among the model's " +
                                       std::to_string(scene.solid_info.size()));
    const Names& names = impl_->names();
    const SolidInfo& info = scene.solid_info[index];
    const Shape& shape = std::get<Solid>(names.scene().objects[names.find(info.name)]).shape;
    const bool is_made_of_parts = std::holds_alternative<Pipe>(shape) || std::holds_alternative<Cline>(shape);
    return placed(is_made_of_parts ? parts_of(shape).parts[info.piece].shape : shape, scene.solid_matrices[index]);
}

Matrix Model::matrix_of(const std::string& path) const {
    const FloatingPoint own;
    const Names& names = impl_->names();
    const Scene& scene = names.scene();
    const ObjectPath found = follow_path(scene, names, path);
    return csgrt::matrix_of(names, found, found.steps.size() - 1);
}

Matrix Model::placement_of(const std::string& path) const {
    const FloatingPoint own;
    const Names& names = impl_->names();
    const Scene& scene = names.scene();
    const ObjectPath found = follow_path(scene, names, path);
    return csgrt::placement_of(names, found, found.steps.size() - 1);
}

std::vector<ChildInfo> Model::children(const std::string& path) const {
    const FloatingPoint own;
    const Names& names = impl_->names();
    const Scene& scene = names.scene();
    std::vector<ChildInfo> found;
    const auto add = [&](std::string way, std::string name, std::uint32_t object, Operator op) {
        const Object& child = scene.objects[object];
        found.push_back({std::move(way), std::move(name), name_of(child), type_name(child), op});
    };
    const std::string above = normal_path(path);
    if (above == "/") {
        const std::vector<std::string>& objects = impl_->source.objects;
        for (const std::string& root : objects.empty() ? names.top_objects() : objects) {
            const std::string way = normal_path(root);
            add(way, way.substr(1), follow_path(scene, names, root).object(), Operator::union_);
        }
        return found;
    }
    const std::uint32_t parent = follow_path(scene, names, path).object();
    const auto* combination = std::get_if<Combination>(&scene.objects[parent]);
    if (combination == nullptr) return found;
    const std::vector<Operator> joining = joints(combination->tree.nodes);
    for (std::uint32_t node = 0; node < joining.size(); ++node) {
        const std::uint32_t child = names.child(parent, node);
        const std::string& name = names.member_name(parent, node);
        if (child < Names::left_out) add(above + "/" + name, name, child, joining[node]);
    }
    return found;
}

}  // namespace csgrt
