#include "compile/flatten/tree.hpp"

#include <string>

#include "scene/vector.hpp"

namespace csgrt {

Flattener::Kind Flattener::write(const RegionForest& forest, std::uint32_t term, FlatTree& tree) {
    tree_ = &tree;
    operands_.clear();
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
    return operands_.back().kind;
}

void Flattener::expand(std::uint32_t object, const Matrix& matrix) {
    enter(object, matrix);
    while (!frames_.empty()) {
        Frame& frame = frames_.back();
        const std::vector<TreeNode>& nodes = frame.combination->tree.nodes;
        if (frame.next == nodes.size()) {
            if (nodes.empty()) operands_.push_back({tree_->nodes.size(), Kind::nothing});
            if (leaves_ == frame.first_leaf) hollow_.emplace(frame.combination, operands_.back().kind);
            frames_.pop_back();
            continue;
        }
        const std::size_t number = frame.next++;
        const TreeNode& node = nodes[number];
        if (node.op == Operator::leaf) {
            const std::uint32_t child = index_.child(frame.object, number);
            if (child != Names::left_out) {
                enter(child, compose(frame.matrix, node.matrix));
            } else {
                operands_.push_back({tree_->nodes.size(), Kind::nothing});
            }
        } else {
            operate(node.op, node.arity);
        }
    }
}

void Flattener::enter(std::uint32_t object, const Matrix& matrix) {
    index_.check_references(++result_.references);
    const Names::Kind kind = index_.kind(object);
    if (kind < Names::Kind::solid) {
        const Combination* combination = &std::get<Combination>(scene_.objects[object]);
        if (const auto known = hollow_.find(combination); known != hollow_.end()) {
            operands_.push_back({tree_->nodes.size(), known->second});
        } else {
            frames_.push_back({combination, object, matrix, 0, leaves_});
        }
        return;
    }
    if (kind == Names::Kind::left_out) {
        operands_.push_back({tree_->nodes.size(), Kind::nothing});
        return;
    }
    ++leaves_;
    operands_.push_back({tree_->nodes.size(), Kind::tree});
    if (kind != Names::Kind::composite) {
        tree_->nodes.push_back({Operator::leaf, 0, instance_of(object, 0, matrix)});
        return;
    }
    auto known = result_.composites.find(object);
    if (known == result_.composites.end()) {
        const Shape& shape = std::get<Solid>(scene_.objects[object]).shape;
        known = result_.composites.emplace(object, pieces_of(shape)).first;
    }
    for (FlatTree::Node node : known->second.tree.nodes) {
        if (node.op == Operator::leaf) node.solid = instance_of(object, node.solid, matrix);
        tree_->nodes.push_back(node);
    }
}

std::uint32_t Flattener::instance_of(std::uint32_t object, std::uint32_t piece, const Matrix& matrix) {
    Matrix place = matrix;
    for (double& value : place) value += 0.0;  // -0 and 0 are one place
    if (result_.matrices.empty() || result_.matrices.back() != place) result_.matrices.push_back(place);
    result_.leaves.push_back({object, piece, static_cast<std::uint32_t>(result_.matrices.size() - 1)});
    return static_cast<std::uint32_t>(result_.leaves.size() - 1);
}

void Flattener::append(Operator op, std::size_t arity) {
    tree_->nodes.push_back({op, static_cast<std::uint32_t>(arity), 0});
}

void Flattener::operate(Operator op, std::uint32_t arity) {
    const std::size_t base = operands_.size() - arity;
    const std::size_t first = operands_[base].first;
    const Kind left = operands_[base].kind;
    std::size_t trees = 0, wholes = 0;  // among the operands; the left one of a difference apart
    for (std::size_t i = base + (op == Operator::difference ? 1 : 0); i < operands_.size(); ++i) {
        if (operands_[i].kind == Kind::tree) ++trees;
        if (operands_[i].kind == Kind::everything) ++wholes;
    }
    const std::size_t empties = arity - trees - wholes;
    operands_.resize(base);

    Kind result = Kind::tree;
    bool complement = false;
    switch (op) {
        case Operator::union_:
            result = wholes > 0 ? Kind::everything : trees > 0 ? Kind::tree : Kind::nothing;
            break;
        case Operator::intersection:
            result = empties > 0 ? Kind::nothing : trees > 0 ? Kind::tree : Kind::everything;
            break;
        case Operator::difference:
            if (left == Kind::nothing || wholes > 0) {
                result = Kind::nothing;
            } else if (left == Kind::everything) {
                op = Operator::union_;
                complement = true;
                result = trees > 0 ? Kind::tree : Kind::nothing;
            } else {
                ++trees;
            }
            break;
        case Operator::xor_:
            result = trees > 0 ? Kind::tree : Kind::nothing;
            complement = wholes % 2 == 1;
            break;
        default:  // not
            complement = true;
            result = left;
            break;
    }
    if (result == Kind::tree) {
        if (trees > 1) append(op, trees);
        if (complement) append(Operator::not_, 1);
    } else {
        result_.has_unused = result_.has_unused || tree_->nodes.size() > first;
        tree_->nodes.resize(first);
        if (complement) result = result == Kind::nothing ? Kind::everything : Kind::nothing;
    }
    operands_.push_back({first, result});
}

}  // namespace csgrt
