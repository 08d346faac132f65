// Pruning by table 2.1 of Domingues 2017, after Tilove 1984 and Jansen 1991.
//
// Theory: where it is known that a solid is out, its leaf is a constant, and a gate with a constant operand is the
// other operand, its complement, or a constant itself:
//
//   and   out, B -> out   in, B -> B          or   out, B -> B   in, B -> in       xor   out, B -> B   in, B -> not B
//
// (A - B is A and not B; a solid that is out makes a complemented leaf in.) What is left has the same value wherever
// the solids are out. Here solids are out for two reasons:
//   per tile       no ray of a tile of 64 rays meets them: the trees are pruned once a tile, and the rays of the tile
//                  walk what is left
//   per partition  they do not cover the partition: a subtree without covering leaves is not walked, its constant
//                  stands in its place
// The thesis also prunes what is in over the whole tile; that takes a test of solids against beams, which is not here.
//
// Cost: per tile, one pass over each tree that the tile meets; per partition, O(covering leaves x height).
// For its speed: trees are flattened by associativity; gates end early (an or that has a true operand); the partitions
// come from a sweep over the ray's events with a list of the covering segments.
// Fails (costs more than it saves) where trees are small, or where each ray of a tile meets other solids.
#include <limits>
#include <mutex>
#include <numeric>

#include "device_method.hpp"
#include "ray_events.hpp"
#include "list.hpp"

namespace csgrt::bench {
namespace {

constexpr std::size_t tile = 64;

/// A region's tree, as a whole or pruned.
struct Tree {
    struct Node {
        Gate gate;
        bool complement;              ///< of the node's value, also of a gate's
        bool empty;                   ///< its value where no solid is
        std::uint32_t left, right;    ///< leaf: left is the solid
        std::uint32_t first, leaves;  ///< its leaves, numbered from left to right
    };
    std::vector<Node> nodes;  ///< operands before their gates; none: false everywhere
    /// Where solids stand: solid, number of the leaf. Ascending.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> places;

    /// Fills in `empty`, `first`, `leaves` and `places`.
    void number() {
        for (Node& node : nodes) {
            if (node.gate == Gate::leaf) {
                node.leaves = 1;
                node.empty = node.complement;
                continue;
            }
            const Node &l = nodes[node.left], &r = nodes[node.right];
            node.leaves = l.leaves + r.leaves;
            node.empty = node.complement != (node.gate == Gate::intersection ? l.empty && r.empty
                                             : node.gate == Gate::union_     ? l.empty || r.empty
                                                                             : l.empty != r.empty);
        }
        if (nodes.empty()) return;
        nodes.back().first = 0;
        for (std::size_t i = nodes.size(); i-- > 0;) {
            const Node& node = nodes[i];
            if (node.gate == Gate::leaf) {
                places.emplace_back(node.left, node.first);
                continue;
            }
            nodes[node.left].first = node.first;
            nodes[node.right].first = node.first + nodes[node.left].leaves;
        }
        std::sort(places.begin(), places.end());
    }
};

Tree whole(const PositiveTree& positive) {
    Tree tree;
    for (const PositiveTree::Node& node : positive.nodes)
        tree.nodes.push_back({node.gate, node.complement, false, node.left, node.right, 0, 0});
    tree.number();
    return tree;
}

/// Without the solids that are not among `present` (ascending). Table 2.1.
Tree pruned(const Tree& tree, const std::vector<std::uint32_t>& present) {
    struct Operand {
        bool is_constant, value;  ///< value: of a constant; else whether `node` is complemented
        std::uint32_t node;       ///< in `kept`
    };
    std::vector<Tree::Node> kept;
    std::vector<Operand> operands;
    operands.reserve(tree.nodes.size());
    for (const Tree::Node& node : tree.nodes) {
        const auto add = [&](Tree::Node copy, bool complement) {
            kept.push_back(copy);
            operands.push_back({false, complement, static_cast<std::uint32_t>(kept.size() - 1)});
        };
        if (node.gate == Gate::leaf) {
            if (std::binary_search(present.begin(), present.end(), node.left))
                add({Gate::leaf, false, false, node.left, 0, 0, 0}, node.complement);
            else
                operands.push_back({true, node.complement, 0});
            continue;
        }
        Operand a = operands[node.left], b = operands[node.right];
        if (b.is_constant) std::swap(a, b);
        if (!a.is_constant) {
            kept[a.node].complement = a.value;
            kept[b.node].complement = b.value;
            add({node.gate, false, false, a.node, b.node, 0, 0}, node.complement);
            continue;
        }
        Operand result = b;
        if (node.gate == Gate::xor_)
            result.value = result.value != a.value;
        else if (a.value == (node.gate == Gate::union_))
            result = a;
        result.value = result.value != node.complement;
        operands.push_back(result);
    }
    // Kept nodes that no constant has swallowed, in the same order.
    Tree left;
    if (operands.empty() || operands.back().is_constant) return left;  // true everywhere it cannot be
    const std::uint32_t root = operands.back().node;
    kept[root].complement = operands.back().value;
    std::vector<std::uint32_t> place(kept.size(), 0);
    std::vector<bool> used(kept.size());
    used[root] = true;
    for (std::size_t i = root + 1; i-- > 0;)
        if (used[i] && kept[i].gate != Gate::leaf) used[kept[i].left] = used[kept[i].right] = true;
    for (std::size_t i = 0; i <= root; ++i) {
        if (!used[i]) continue;
        Tree::Node node = kept[i];
        if (node.gate != Gate::leaf) {
            node.left = place[node.left];
            node.right = place[node.right];
        }
        place[i] = static_cast<std::uint32_t>(left.nodes.size());
        left.nodes.push_back(node);
    }
    left.number();
    return left;
}

/// Walks trees at partitions.
class Walker {
public:
    std::uint64_t visited = 0;

    /// `solids`: those that cover, ascending, each once. `by_partition`: subtrees without any are not walked.
    bool holds(const Tree& tree, const std::vector<std::uint32_t>& solids, bool by_partition) {
        if (tree.nodes.empty()) return false;
        // Where the covering solids stand. One may stand in a tree thousands of times: then places are searched
        // instead.
        constexpr std::size_t few = 64;
        covered_.clear();
        for (std::size_t i = 0; by_partition && i < solids.size() && covered_.size() <= few; ++i) {
            auto at = std::lower_bound(tree.places.begin(), tree.places.end(), std::pair(solids[i], 0u));
            for (; at != tree.places.end() && at->first == solids[i] && covered_.size() <= few; ++at)
                covered_.push_back(at->second);
        }
        const bool is_listed = covered_.size() <= few;
        if (is_listed) std::sort(covered_.begin(), covered_.end());
        const auto covers = [&](const Tree::Node& node) {
            if (node.gate == Gate::leaf) return std::binary_search(solids.begin(), solids.end(), node.left);
            if (is_listed) {
                const auto at = std::lower_bound(covered_.begin(), covered_.end(), node.first);
                return at != covered_.end() && *at < node.first + node.leaves;
            }
            return std::any_of(solids.begin(), solids.end(), [&](std::uint32_t solid) {
                const auto at = std::lower_bound(tree.places.begin(), tree.places.end(), std::pair(solid, node.first));
                return at != tree.places.end() && at->first == solid && at->second < node.first + node.leaves;
            });
        };
        frames_.clear();
        auto next = static_cast<std::uint32_t>(tree.nodes.size() - 1);
        for (;;) {
            const Tree::Node& node = tree.nodes[next];
            bool value;
            ++visited;
            if (node.gate == Gate::leaf) {
                value = covers(node) != node.complement;
            } else if (by_partition && !covers(node)) {
                value = node.empty;
            } else {
                frames_.push_back({next, false, false});
                next = node.left;
                continue;
            }
            for (;;) {
                if (frames_.empty()) return value;
                Frame& frame = frames_.back();
                const Tree::Node& gate = tree.nodes[frame.node];
                const bool decides = gate.gate == Gate::union_ ? value : gate.gate == Gate::intersection && !value;
                if (!frame.is_right && !decides) {
                    frame = {frame.node, true, value};
                    next = gate.right;
                    break;
                }
                if (frame.is_right && gate.gate == Gate::xor_) value = value != frame.left;
                value = value != gate.complement;
                frames_.pop_back();
            }
        }
    }

private:
    struct Frame {
        std::uint32_t node;
        bool is_right, left;  ///< the right operand is walked, the left one has this value
    };
    std::vector<std::uint32_t> covered_;
    std::vector<Frame> frames_;
};

class Pruning final : public Tracer {
public:
    Pruning(const Subject& subject, const TraceOptions& options)
        : rays_(subject.compiled),
          options_(options),
          by_partition_(options.knob == 1 || options.knob == 3),
          by_tile_(options.knob == 2 || options.knob == 3),
          regions_of_(regions_of_solids(subject.compiled)) {
        if (!by_partition_ && !by_tile_ && options.knob != 0)
            throw Error(Status::usage, "pruning: its knob is 0 (off), 1 (per partition), 2 (per tile) or 3 (both)");
        for (const PositiveTree& tree : positive_trees(subject.compiled, Grouping::least_height, options.planted))
            trees_.push_back(whole(tree));
    }

    std::vector<Answer> trace(const std::vector<Ray>& rays) override {
        std::vector<Answer> answers(rays.size());
        visited_ = pruned_ = partitions_ = 0;
        seconds_ = trace_in_pieces(options_, tile, answers, [&](std::size_t first, std::size_t last) {
            Memory memory;
            trace(std::span(rays).subspan(first, last - first), answers.data() + first, memory);
            const std::lock_guard lock(mutex_);
            visited_ += memory.walker.visited;
            pruned_ += memory.pruned;
            partitions_ += memory.partitions;
        });
        return answers;
    }
    double seconds() const override { return seconds_; }
    std::map<std::string, double> figures() const override {
        const double partitions = static_cast<double>(std::max<std::uint64_t>(partitions_, 1));
        return {{"nodes a partition", static_cast<double>(visited_) / partitions},
                {"nodes read to prune, a partition", static_cast<double>(pruned_) / partitions}};
    }

private:
    struct Memory {
        std::vector<RayEvents> events;
        std::vector<std::uint32_t> present, regions, solids, claimed, order;
        std::vector<RayEvents::Segment> covering;
        std::map<std::uint32_t, Tree> trees;  ///< of the tile
        Walker walker;
        std::uint64_t pruned = 0, partitions = 0;
    };

    void trace(std::span<const Ray> rays, Answer* answers, Memory& memory) const {
        memory.events.resize(rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i) memory.events[i].find(rays_, rays[i]);
        if (by_tile_) {
            for (const RayEvents& events : memory.events)
                for (const RayEvents::Segment& segment : events.segments) memory.present.push_back(segment.solid);
            std::sort(memory.present.begin(), memory.present.end());
            memory.present.erase(std::unique(memory.present.begin(), memory.present.end()), memory.present.end());
        }
        for (std::size_t i = 0; i < rays.size(); ++i) answers[i].stretches = sweep(memory.events[i], memory);
    }

    Sequence sweep(const RayEvents& events, Memory& memory) const {
        std::vector<std::uint32_t>&claimed = memory.claimed, &order = memory.order;
        std::vector<RayEvents::Segment>& covering = memory.covering;
        claimed.assign(events.steps(), NONE);
        order.resize(events.segments.size());
        std::iota(order.begin(), order.end(), 0u);
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(events.segments[a].in, a) < std::pair(events.segments[b].in, b);
        });
        covering.clear();
        std::size_t next = 0;
        for (std::uint32_t step = 0; step < events.steps(); ++step) {
            bool changed = std::erase_if(covering, [&](const RayEvents::Segment& s) { return s.out <= step; }) > 0;
            for (; next < order.size() && events.segments[order[next]].in == step; ++next) {
                covering.push_back(events.segments[order[next]]);
                changed = true;
            }
            if (!changed) {  // only segments shorter than the tolerance ended here
                if (step > 0) claimed[step] = claimed[step - 1];
                continue;
            }
            if (covering.empty()) continue;
            ++memory.partitions;
            const auto any = [&](const auto& is) { return std::any_of(covering.begin(), covering.end(), is); };
            const bool moved = any([](const auto& s) { return s.missed; }) &&
                               any([&](const auto& s) { return s.solid != covering[0].solid; });
            claimed[step] = NONE;
            for (std::uint32_t side = moved; side < (moved ? SIDES : 1u); ++side)
                claimed[step] = std::min(claimed[step], claim(kernel::missed_on(side), memory));
        }
        return stretches_of(events, claimed);
    }

    /// The least region that claims what the covering segments cover, but those that have any of `missed`.
    std::uint32_t claim(std::uint32_t missed, Memory& memory) const {
        std::vector<std::uint32_t>&solids = memory.solids, &regions = memory.regions;
        solids.clear();
        regions.clear();
        for (const RayEvents::Segment& segment : memory.covering)
            if (!(segment.missed & missed)) solids.push_back(segment.solid);
        std::sort(solids.begin(), solids.end());
        solids.erase(std::unique(solids.begin(), solids.end()), solids.end());
        for (const std::uint32_t solid : solids)
            regions.insert(regions.end(), regions_of_[solid].begin(), regions_of_[solid].end());
        std::sort(regions.begin(), regions.end());
        regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
        for (const std::uint32_t region : regions)
            if (memory.walker.holds(tree_of(region, memory), solids, by_partition_)) return region;
        return NONE;
    }

    const Tree& tree_of(std::uint32_t region, Memory& memory) const {
        if (!by_tile_) return trees_[region];
        const auto found = memory.trees.find(region);
        if (found != memory.trees.end()) return found->second;
        memory.pruned += trees_[region].nodes.size();
        return memory.trees.emplace(region, pruned(trees_[region], memory.present)).first->second;
    }

    SceneRays rays_;
    TraceOptions options_;
    bool by_partition_, by_tile_;
    std::vector<std::vector<std::uint32_t>> regions_of_;
    std::vector<Tree> trees_;  ///< one a region
    double seconds_ = 0;
    std::uint64_t visited_ = 0, pruned_ = 0, partitions_ = 0;
    std::mutex mutex_;
};

}  // namespace

Method pruning() {
    return {.name = "pruning",
            .source = "Tilove 1984, Jansen 1991",
            .about =
                "Solids that are out, because no ray of a tile meets them or because they do not cover the "
                "partition, are cut from the trees by table 2.1 before these are walked. Trees are flattened "
                "first, and gates end early.",
            .breaks =
                "depth and overlaps: trees are of one or few leaves there, so pruning saves nothing and costs "
                "its passes. No family makes it wrong.",
            .knob = "0 off, 1 per partition, 2 per tile of 64 rays, 3 both",
            .knob_values = {0, 1, 2, 3},
            .prepare = [](const Subject& subject, const TraceOptions& options) {
                return std::make_unique<Pruning>(subject, options);
            }};
}

}  // namespace csgrt::bench
