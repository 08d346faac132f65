#include "compile/flatten/flattener.hpp"

#include <span>

#include "scene/vector.hpp"

namespace csgrt {

Constants Flattener::write(const RegionForest& forest, std::uint32_t term, FlatTree& tree) {
    tree_ = &tree;
    firsts_.clear();
    values_.clear();
    outsides_.clear();
    struct Task {
        std::uint32_t node;
        bool operands_done;
    };
    std::vector<Task> tasks{{term, false}};
    while (!tasks.empty()) {
        const auto [number, operands_done] = tasks.back();
        tasks.pop_back();
        const RegionForest::Node& node = forest.node(number);
        if (node.op == Operator::leaf) {
            const RegionStart& start = forest.start(node.left);
            expand(start.object, forest.matrix_of(start));
        } else if (operands_done) {
            operate(node.op, node.op == Operator::not_ ? 1 : 2);
        } else {
            tasks.push_back({number, true});
            if (node.op != Operator::not_) tasks.push_back({node.right, false});
            tasks.push_back({node.left, false});
        }
    }
    return {values_.back(), outsides_.back()};
}

void Flattener::expand(std::uint32_t object, const Matrix& matrix) {
    if (const std::optional<Level> level = enter(object, matrix)) walk_.below(source_.names, object, *level, *this);
}

std::optional<Flattener::Level> Flattener::enter(std::uint32_t object, const Matrix& matrix) {
    source_.references.check(++result_.references);
    const Names::Kind kind = source_.names.kind(object);
    if (kind < Names::Kind::solid) {
        const auto known = constants_.find(object);
        if (known == constants_.end()) return Level{matrix, leaves_};
        push(known->second, known->second);
        return {};
    }
    if (kind == Names::Kind::left_out) {
        nothing();
        return {};
    }
    ++leaves_;
    push(Value::tree, Value::nothing);
    if (kind != Names::Kind::composite) {
        tree_->nodes.push_back({Operator::leaf, 0, instance_of(object, 0, matrix)});
        return {};
    }
    auto known = result_.composites.find(object);
    if (known == result_.composites.end()) {
        const Shape& shape = std::get<Solid>(source_.scene.objects[object]).shape;
        known = result_.composites.emplace(object, parts_of(shape)).first;
    }
    for (FlatTree::Node node : known->second.tree.nodes) {
        if (node.op == Operator::leaf) node.solid = instance_of(object, node.solid, matrix);
        tree_->nodes.push_back(node);
    }
    return {};
}

std::optional<Flattener::Level> Flattener::follow(const Open& parent, std::uint32_t node, std::uint32_t child) {
    return enter(child, compose(parent.level.matrix, source_.names.matrix(parent.object, node)));
}

void Flattener::operate(const Open& parent, std::uint32_t node) {
    const TreeNode& operation = source_.names.node(parent.object, node);
    operate(operation.op, operation.arity);
}

void Flattener::leave(const Open& done) {
    if (leaves_ == done.level.first_leaf) constants_.emplace(done.object, values_.back());
}

void Flattener::push(Value value, Value outside) {
    firsts_.push_back(tree_->nodes.size());
    values_.push_back(value);
    outsides_.push_back(outside);
}

std::uint32_t Flattener::instance_of(std::uint32_t object, std::uint32_t piece, const Matrix& matrix) {
    Matrix place = matrix;
    for (double& value : place) value += 0.0;  // -0 and 0 are one value
    if (result_.matrices.empty() || result_.matrices.back() != place) result_.matrices.push_back(place);
    result_.leaves.push_back({object, piece, static_cast<std::uint32_t>(result_.matrices.size() - 1)});
    return static_cast<std::uint32_t>(result_.leaves.size() - 1);
}

void Flattener::operate(Operator op, std::size_t arity) {
    const std::size_t base = values_.size() - arity, first = firsts_[base];
    const std::size_t end = tree_->nodes.size();
    const Value value = append_folded(tree_->nodes, first, op, std::span(values_).subspan(base));
    const Value outside = fold(op, std::span(outsides_).subspan(base)).value;
    result_.has_unused = result_.has_unused || (value != Value::tree && end > first);
    firsts_.resize(base + 1);  // the nodes of the first operand are kept
    values_.resize(base);
    values_.push_back(value);
    outsides_.resize(base);
    outsides_.push_back(outside);
}

}  // namespace csgrt
