// Ulyanov, Bogolepov, Turlapov 2017: "Interactive vizualization of constructive solid geometry scenes on graphic
// processors"; the phases are those of the thesis, section 2.2.
//
// Theory: a tree is rewritten before it is traced, in four phases:
//
//   1  the positive form: complements at the leaves, unions and intersections above them
//   2  treelets: the operands of a chain of one operator are grouped anew by their boxes, so that a ray which misses
//   one
//      side misses a whole subtree. Here they are halved at the middle of the longest side of their centres' box
//   3  least height: (a + b) + c becomes a + (b + c) where a is the highest, and the same for intersections
//   4  back to the general form: complements become differences
//
// What traces the tree is Kensler's machine (kensler.cpp), unchanged, with its finest epsilon.
//
// Cost: n log^2 n once a tree. Nothing can become wrong that Kensler has right: the trees are equivalent.
// Prediction: beside the laboratory's trees near nothing, since those are balanced, and of each ray only the part that
// its candidates reach is kept: what boxes would cull is gone before. Beside chains as files have them it gains what
// balancing gains. Broken by deep_trees whose operators alternate: there is no treelet to group, and the height stays.
#include <algorithm>
#include <cmath>

#include "compile/linear.hpp"
#include "list.hpp"
#include "positive_tree.hpp"
#include "region_trees.hpp"

namespace csgrt::bench {
namespace {

enum class Trees { chains, balanced, optimized };

/// A tree without its complements as RegionTrees reads it.
FlatTree flat(const GeneralTree& tree) {
    FlatTree flat;
    // Backwards: a node, its right operand, its left one.
    if (tree.root.complement) flat.nodes.push_back({Operator::not_, 1, 0});
    std::vector<std::uint32_t> rest{tree.root.node};
    while (!rest.empty()) {
        const GeneralTree::Node& node = tree.nodes[rest.back()];
        rest.pop_back();
        const bool is_leaf = node.op == Operator::leaf;
        flat.nodes.push_back({node.op, is_leaf ? 0u : 2u, is_leaf ? node.left : 0});
        if (!is_leaf) rest.insert(rest.end(), {node.left, node.right});
    }
    std::reverse(flat.nodes.begin(), flat.nodes.end());
    return flat;
}

class Optimizer {
public:
    Optimizer(const PositiveTree& tree, const SharedVector<Box>& boxes) : tree_(tree), boxes_(boxes) {}

    GeneralTree run() {
        std::vector<std::vector<std::uint32_t>> operands(tree_.nodes.size());  // of the chain that ends at a node
        for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i) {
            const PositiveTree::Node& node = tree_.nodes[i];
            if (node.gate == Gate::leaf) {
                parts_.push_back({Gate::leaf, i, 0, 0, boxes_[node.left]});
                operands[i] = {static_cast<std::uint32_t>(parts_.size() - 1)};
                continue;
            }
            for (const std::uint32_t operand : {node.left, node.right}) {
                std::vector<std::uint32_t> below = std::move(operands[operand]);
                const Gate gate = tree_.nodes[operand].gate;
                if (gate != node.gate && gate != Gate::leaf) below = {group(gate, below.data(), below.size())};
                if (operands[i].size() < below.size()) operands[i].swap(below);
                operands[i].insert(operands[i].end(), below.begin(), below.end());
            }
        }
        return general(group(tree_.nodes.back().gate, operands.back().data(), operands.back().size()));
    }

private:
    struct Part {
        Gate gate;
        std::uint32_t left, right;  ///< parts; leaf: the positive tree's node
        std::uint32_t height;
        Box box;
    };

    /// Phase 2: one part of all of a treelet's.
    std::uint32_t group(Gate gate, std::uint32_t* parts, std::size_t count) {
        if (count == 1) return parts[0];
        Box centers = empty_box;
        for (std::size_t i = 0; i < count; ++i) extend(centers, center(parts[i]));
        const double x = centers.high.x - centers.low.x, y = centers.high.y - centers.low.y;
        const double z = centers.high.z - centers.low.z;
        const auto along = [&](const Vec3& p) { return x >= y && x >= z ? p.x : y >= z ? p.y : p.z; };
        const std::size_t half = count / 2;
        std::nth_element(parts, parts + half, parts + count, [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(along(center(a)), a) < std::pair(along(center(b)), b);
        });
        const std::uint32_t left = group(gate, parts, half);
        return join(gate, left, group(gate, parts + half, count - half));
    }

    /// Phase 3: of a much higher operand of the same gate the higher one stays at the top.
    std::uint32_t join(Gate gate, std::uint32_t a, std::uint32_t b) {
        if (parts_[a].height < parts_[b].height) std::swap(a, b);
        if (parts_[a].gate == gate) {
            std::uint32_t high = parts_[a].left, low = parts_[a].right;
            if (parts_[high].height < parts_[low].height) std::swap(high, low);
            if (parts_[high].height > std::max(parts_[low].height, parts_[b].height))
                return join(gate, high, join(gate, low, b));
        }
        const Part &p = parts_[a], &q = parts_[b];
        const Box box = gate == Gate::intersection ? intersected(p.box, q.box) : united(p.box, q.box);
        parts_.push_back({gate, a, b, p.height + 1, box});
        return static_cast<std::uint32_t>(parts_.size() - 1);
    }

    Vec3 center(std::uint32_t part) const {
        const Box& box = parts_[part].box;
        const auto middle = [](double a, double b) { return std::isfinite(a + b) ? 0.5 * (a + b) : 0.0; };
        return {middle(box.low.x, box.high.x), middle(box.low.y, box.high.y), middle(box.low.z, box.high.z)};
    }

    /// Phase 4. Operands stand before their parts; parts that phase 3 took apart are in no other.
    GeneralTree general(std::uint32_t root) const {
        std::vector<bool> is_used(parts_.size());
        is_used[root] = true;
        for (std::uint32_t i = root + 1; i-- > 0;)
            if (is_used[i] && parts_[i].gate != Gate::leaf) is_used[parts_[i].left] = is_used[parts_[i].right] = true;
        GeneralTree tree;
        std::vector<GeneralTree::Edge> edges(parts_.size());
        for (std::uint32_t i = 0; i <= root; ++i) {
            const Part& part = parts_[i];
            if (!is_used[i]) continue;
            if (part.gate == Gate::leaf) {
                edges[i] = tree.add_leaf(tree_.nodes[part.left].left);
                edges[i].complement = tree_.nodes[part.left].complement;
            } else {
                edges[i] = tree.add(part.gate, edges[part.left], edges[part.right]);
            }
        }
        tree.root = edges[root];
        return tree;
    }

    const PositiveTree& tree_;
    const SharedVector<Box>& boxes_;
    std::vector<Part> parts_;
};

/// The heights of the regions' trees: their sum, and the largest.
std::pair<double, std::uint32_t> heights(const RegionTrees& trees, std::size_t regions) {
    std::vector<std::uint32_t> height;
    for (const RegionTrees::Node& node : trees.nodes())
        height.push_back(node.gate == Gate::leaf ? 0 : 1 + std::max(height[node.left >> 1], height[node.right >> 1]));
    double sum = 0;
    std::uint32_t largest = 0;
    for (std::uint32_t region = 0; region < regions; ++region) {
        if (trees.root(region) >= EMPTY_SET) continue;
        sum += height[trees.root(region) >> 1];
        largest = std::max(largest, height[trees.root(region) >> 1]);
    }
    return {sum, largest};
}

/// Kensler's tracer of a scene with other trees.
class UlyanovTracer final : public Tracer {
public:
    UlyanovTracer(const Subject& subject, const TraceOptions& options, Trees trees) : compiled_(subject.compiled) {
        const Method machine = kensler();
        TraceOptions inner = options;
        inner.knob = machine.knob_values.back();
        if (trees != Trees::balanced) {
            inner.planted = false;  // the new trees have the fault in them
            std::vector<FlatTree> made;
            for (const FlatTree& tree : subject.compiled.flat_trees) {
                if (trees == Trees::chains) {
                    made.push_back(flat(general_form(tree, options.planted)));
                    continue;
                }
                const PositiveTree positive = positive_tree(tree, Grouping::least_height, options.planted);
                made.push_back(flat(Optimizer(positive, compiled_.solid_boxes).run()));
            }
            compiled_.flat_trees = std::move(made);
        }
        const std::size_t regions = compiled_.flat_trees.size();
        const auto [sum, largest] = heights(RegionTrees(compiled_, false), regions);
        figures_ = {{"height of a tree", sum / static_cast<double>(std::max<std::size_t>(regions, 1))},
                    {"largest height", static_cast<double>(largest)}};
        tracer_ = machine.prepare({subject.scene, subject.objects, compiled_}, inner);
    }

    std::vector<Answer> trace(const std::vector<Ray>& rays) override { return tracer_->trace(rays); }
    double seconds() const override { return tracer_->seconds(); }
    std::map<std::string, double> figures() const override {
        std::map<std::string, double> all = tracer_->figures();
        all.insert(figures_.begin(), figures_.end());
        return all;
    }

private:
    CompiledScene compiled_;
    std::map<std::string, double> figures_;
    std::unique_ptr<Tracer> tracer_;
};

}  // namespace

Method ulyanov() {
    Method m;
    m.name = "Ulyanov";
    m.source = "Ulyanov et al. 2017";
    m.about =
        "Rewrites the trees before Kensler's machine traces them: positive form, treelets of one operator grouped by "
        "boxes, least height, back to differences. Its trees are compared with chains to the left and with the "
        "laboratory's balanced ones.";
    m.breaks =
        "deep_trees whose operators alternate have no treelets, and keep their height. slivers, edges, pinch and "
        "coincident: as Kensler.";
    m.knob = "trees: 0 chains to the left, 1 balanced, 2 optimized";
    m.knob_values = {0, 1, 2};
    m.exact = false;
    m.prepare = [](const Subject& subject, const TraceOptions& options) -> std::unique_ptr<Tracer> {
        if (options.knob != 0 && options.knob != 1 && options.knob != 2)
            throw Error(Status::usage, "Ulyanov: the knob is 0 (chains), 1 (balanced) or 2 (optimized)");
        return std::make_unique<UlyanovTracer>(subject, options, static_cast<Trees>(options.knob));
    };
    return m;
}

}  // namespace csgrt::bench
