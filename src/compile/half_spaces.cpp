// Half-spaces are moved down trees. (A + B + (C - D)) and H becomes (A and H) + B + (C and H) - D, if H cuts A and C
// and contains B. So terms stay small, and only the terms of cut solids have H.

#include "compile/half_spaces.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "compile/bounds/bounds.hpp"
#include "compile/flatten/fold.hpp"
#include "compile/linear.hpp"
#include "compile/solids/polyhedron.hpp"

namespace csgrt {

namespace {

/// One entry an instance: the plane, if it is a half-space.
using HalfSpaces = std::vector<std::optional<Plane>>;

enum class Side { inside, cut, outside };

/// The side of a plane on which a box lies. `margin`: a box within this distance of the plane counts as cut.
Side side_of(const Box& box, const Plane& plane, double margin) {
    if (!is_finite(box)) return Side::cut;
    double low = -plane.distance, high = -plane.distance;
    const auto add = [&](double n, double a, double b) {
        low += std::min(n * a, n * b);
        high += std::max(n * a, n * b);
    };
    add(plane.normal.x, box.low.x, box.high.x);
    add(plane.normal.y, box.low.y, box.high.y);
    add(plane.normal.z, box.low.z, box.high.z);
    return high < -margin ? Side::inside : low > margin ? Side::outside : Side::cut;
}

/// The cutter moves half-spaces down trees, to the solids that they cut.
class Cutter {
public:
    Cutter(const HalfSpaces& halves, const std::vector<Box>& boxes, double margin)
        : halves_(halves), boxes_(boxes), margin_(margin) {}

    FlatTree cut(const FlatTree& tree) {
        given_ = &tree.nodes;
        subtrees_ = subtree_boxes(tree, boxes_);
        first_.clear();
        for (std::uint32_t node = 0; node < tree.nodes.size(); ++node) {
            std::uint32_t first = node;
            for (std::uint32_t k = 0; k < tree.nodes[node].arity; ++k) first = first_[first - 1];
            first_.push_back(first);
        }
        cuts_.clear();
        taking_.clear();
        places_.clear();
        values_.clear();
        FlatTree result;
        nodes_ = &result.nodes;
        tasks_.assign(1, {static_cast<std::uint32_t>(tree.nodes.size() - 1), none, 0});
        while (!tasks_.empty()) {
            const Task task = tasks_.back();
            tasks_.pop_back();
            if (task.operands > 0) {
                operate(tree.nodes[task.node].op, task.operands);
                apply(task.cuts);
            } else {
                enter(task.node, task.cuts);
            }
            // A half-space that cuts nearly all solids would be written too often, so such a tree is left as it is.
            if (std::max(nodes_->size(), cuts_.size()) > 4 * tree.nodes.size() + 64) return tree;
        }
        return result;
    }

    /// Does a cut of the last tree leave nothing of the solid?
    bool takes(std::uint32_t solid) const {
        return std::any_of(taking_.begin(), taking_.end(), [&](const Cut& cut) { return takes(cut, boxes_[solid]); });
    }

private:
    static constexpr std::uint32_t none = 0xffffffff;
    /// An element of a list of cuts. The part inside the half-space is kept, or the part outside.
    struct Cut {
        std::uint32_t half;
        bool keeps_outside;
        std::uint32_t next;
    };
    struct Task {
        std::uint32_t node, cuts;
        std::uint32_t operands;  ///< 0: the node is next; else these operands are written, and their operator is next
    };

    bool is_half(std::uint32_t node) const {
        const FlatTree::Node& leaf = (*given_)[node];
        return leaf.op == Operator::leaf && halves_[leaf.solid].has_value();
    }

    void enter(std::uint32_t node, std::uint32_t cuts) {
        const Operator op = (*given_)[node].op;
        operands_.clear();
        for (std::uint32_t next = node; operands_.size() < (*given_)[node].arity; next = first_[next - 1])
            operands_.push_back(next - 1);  // in reverse order
        if (op == Operator::intersection || op == Operator::difference) cuts = take_halves(op, cuts);
        const std::optional<std::uint32_t> left = left_of(cuts, subtrees_[node]);
        if (!left) return push(Value::nothing);
        if (op == Operator::leaf) {
            push(Value::tree);
            nodes_->push_back((*given_)[node]);
            return apply(*left);
        }
        const bool is_passed_on = op == Operator::union_ || op == Operator::intersection || op == Operator::difference;
        tasks_.push_back({node, is_passed_on ? none : *left, static_cast<std::uint32_t>(operands_.size())});
        std::uint32_t cut_one = operands_.back();  // for a difference and an intersection one operand is enough
        if (op == Operator::intersection)
            cut_one = *std::min_element(operands_.begin(), operands_.end(), [&](std::uint32_t a, std::uint32_t b) {
                return diagonal(subtrees_[a]) < diagonal(subtrees_[b]);
            });
        for (const std::uint32_t operand : operands_)
            tasks_.push_back(
                {operand, op == Operator::union_ || (is_passed_on && operand == cut_one) ? *left : none, 0});
    }

    /// Moves the half-spaces among the operands to the cuts, unless no other operand would be left. Returns the cuts.
    std::uint32_t take_halves(Operator op, std::uint32_t cuts) {
        const bool is_difference = op == Operator::difference;
        const auto end = is_difference ? operands_.end() - 1 : operands_.end();
        const auto kept =
            std::stable_partition(operands_.begin(), end, [&](std::uint32_t operand) { return !is_half(operand); });
        if (is_difference ? is_half(operands_.back()) : kept == operands_.begin()) return cuts;
        for (auto half = kept; half != end; ++half) cuts = add({(*given_)[*half].solid, is_difference, cuts});
        operands_.erase(kept, end);
        return cuts;
    }

    std::uint32_t add(const Cut& cut) {
        cuts_.push_back(cut);
        return static_cast<std::uint32_t>(cuts_.size() - 1);
    }

    bool takes(const Cut& cut, const Box& box) const {
        return side_of(box, *halves_[cut.half], margin_) == (cut.keeps_outside ? Side::inside : Side::outside);
    }

    /// Returns the cuts that go through the box; nullopt if the cuts leave nothing of the box.
    std::optional<std::uint32_t> left_of(std::uint32_t cuts, const Box& box) {
        std::uint32_t left = none, count = 0, left_count = 0;
        for (std::uint32_t i = cuts; i != none; i = cuts_[i].next, ++count) {
            const Cut cut = cuts_[i];
            if (takes(cut, box)) {
                const auto is_known = [&](const Cut& other) {
                    return other.half == cut.half && other.keeps_outside == cut.keeps_outside;
                };
                if (std::none_of(taking_.begin(), taking_.end(), is_known)) taking_.push_back(cut);
                return {};
            }
            if (side_of(box, *halves_[cut.half], margin_) != Side::cut) continue;
            left = add({cut.half, cut.keeps_outside, left});
            ++left_count;
        }
        if (left_count < count) return left;
        cuts_.resize(cuts_.size() - count);  // the list is unchanged
        return cuts;
    }

    void apply(std::uint32_t cuts) {
        for (; cuts != none; cuts = cuts_[cuts].next) {
            push(Value::tree);
            nodes_->push_back({Operator::leaf, 0, cuts_[cuts].half});
            operate(cuts_[cuts].keeps_outside ? Operator::difference : Operator::intersection, 2);
        }
    }

    void push(Value value) {
        places_.push_back(nodes_->size());
        values_.push_back(value);
    }

    void operate(Operator op, std::size_t arity) {
        const std::size_t base = values_.size() - arity;
        values_[base] = append_folded(*nodes_, places_[base], op, std::span(values_).subspan(base));
        places_.resize(base + 1);
        values_.resize(base + 1);
    }

    const HalfSpaces& halves_;
    const std::vector<Box>& boxes_;
    const double margin_;
    const std::vector<FlatTree::Node>* given_ = nullptr;
    std::vector<Box> subtrees_;         ///< one around each node's subtree
    std::vector<std::uint32_t> first_;  ///< the first node of each subtree
    std::vector<FlatTree::Node>* nodes_ = nullptr;
    std::vector<Cut> cuts_;
    std::vector<Task> tasks_;
    std::vector<std::uint32_t> operands_;  ///< of the current node
    std::vector<std::size_t> places_;      ///< where written operands begin
    std::vector<Value> values_;
    std::vector<Cut> taking_;
};

/// A ray that grazes a plate may meet the plate outside its box.
bool is_plate(const Shape& shape) {
    const auto* bot = std::get_if<Bot>(&shape);
    return bot != nullptr && bot->mode != Bot::Mode::volume;
}

/// The regions that use a solid: bounded regions only, or unbounded regions, too.
enum class Use : std::uint8_t { none, bounded, unbounded };

template <class Call>
void for_each_leaf(const FlatTree& tree, const Call& call) {
    for (const FlatTree::Node& node : tree.nodes)
        if (node.op == Operator::leaf) call(node.solid);
}

Box widened(const Box& box, double by) {
    return {{box.low.x - by, box.low.y - by, box.low.z - by}, {box.high.x + by, box.high.y + by, box.high.z + by}};
}

}  // namespace

std::vector<Plane> sides_of(const Box& box) {
    return {{{-1, 0, 0}, -box.low.x}, {{0, -1, 0}, -box.low.y}, {{0, 0, -1}, -box.low.z},
            {{1, 0, 0}, box.high.x},  {{0, 1, 0}, box.high.y},  {{0, 0, 1}, box.high.z}};
}

Clipped clip_by_half_spaces(const Scene& scene, const FlatScene& flat, const std::vector<Box>& boxes) {
    HalfSpaces halves(boxes.size());
    bool any = false;
    Box around = empty_box;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (is_finite(boxes[i])) {
            around = united(around, boxes[i]);
        } else if (const auto* half = std::get_if<Half>(&shape_of(scene, flat, flat.instances[i]))) {
            halves[i] = transform_plane(*flat.instances[i].matrix, half->plane);
            any = true;
        }
    }
    if (!any || is_empty(around)) return {};

    std::vector<Box> limits = boxes;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        if (is_plate(shape_of(scene, flat, flat.instances[i]))) limits[i] = whole_space;
    // The margin is far more than rounding, and than the distance within which boundaries are one event.
    const double margin =
        1e-5 * diagonal(around) + 4 * scene.tolerance + 16 * coordinate_rounding * largest_coordinate(around);
    Clipped result;
    result.bounded_box = widened(around, margin);
    Cutter cutter(halves, limits, margin);
    std::vector<Use> uses(boxes.size(), Use::none);
    for (const FlatRegion& region : flat.regions) {
        result.trees.push_back(cutter.cut(region.tree));
        const FlatTree& cut = result.trees.back();
        for_each_leaf(cut, [&](std::uint32_t solid) { uses[solid] = std::max(uses[solid], Use::bounded); });
        const Use of_halves = is_finite(tree_box(region.tree, limits)) ? Use::bounded : Use::unbounded;
        for_each_leaf(region.tree, [&](std::uint32_t solid) {
            // The reference evaluates the original tree. And a solid that was subtracted from a removed solid may end
            // within the tolerance of another solid's boundary: then the two boundaries are one event.
            uses[solid] = std::max(uses[solid], halves[solid]         ? of_halves
                                                : cutter.takes(solid) ? Use::none
                                                                      : Use::bounded);
        });
    }
    result.ray_boxes = boxes;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        Box& box = result.ray_boxes[i];
        if (uses[i] == Use::none) {
            box = empty_box;
        } else if (halves[i] && uses[i] == Use::bounded) {
            std::vector<Plane> faces = sides_of(result.bounded_box);
            faces.push_back(*halves[i]);
            box = polyhedron_box(faces);
            box = is_empty(box) ? empty_box : widened(box, 1e-9 * diagonal(box));
        }
    }
    return result;
}

}  // namespace csgrt
