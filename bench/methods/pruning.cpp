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
#include <numeric>

#include "device_method.hpp"
#include "each_ray.hpp"
#include "list.hpp"
#include "ray_events.hpp"

namespace csgrt::bench {
namespace {

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
            node.empty = node.complement != value_of(node.gate, l.empty, r.empty);
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

struct Shared : EventScene {
    bool by_partition, by_tile;
    std::vector<Tree> trees = {};  ///< one a region
};

class Worker {
public:
    explicit Worker(const Shared& shared) : shared_(shared) {}
    Counts counts() const {
        return {{"nodes a partition", {walker_.visited, partitions_}},
                {"nodes read to prune, a partition", {pruned_, partitions_}}};
    }

    void trace_tile(std::span<const Ray> rays, Answer* answers) {
        events_.resize(rays.size());
        pruned_trees_.clear();
        present_.clear();
        for (std::size_t i = 0; i < rays.size(); ++i) events_[i].find(shared_.rays, rays[i]);
        if (shared_.by_tile) {
            for (const RayEvents& events : events_)
                for (const RayEvents::Segment& segment : events.segments) present_.push_back(segment.solid);
            sort_once(present_);
        }
        for (std::size_t i = 0; i < rays.size(); ++i) answers[i].stretches = sweep(events_[i]);
    }

private:
    Sequence sweep(const RayEvents& events) {
        claimed_.assign(events.steps(), NONE);
        order_.resize(events.segments.size());
        std::iota(order_.begin(), order_.end(), 0u);
        std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(events.segments[a].in, a) < std::pair(events.segments[b].in, b);
        });
        covering_.clear();
        std::size_t next = 0;
        for (std::uint32_t step = 0; step < events.steps(); ++step) {
            bool changed = std::erase_if(covering_, [&](const RayEvents::Segment& s) { return s.out <= step; }) > 0;
            for (; next < order_.size() && events.segments[order_[next]].in == step; ++next) {
                covering_.push_back(events.segments[order_[next]]);
                changed = true;
            }
            if (!changed) {  // only segments shorter than the tolerance ended here
                if (step > 0) claimed_[step] = claimed_[step - 1];
                continue;
            }
            if (covering_.empty()) continue;
            ++partitions_;
            const auto any = [&](const auto& is) { return std::any_of(covering_.begin(), covering_.end(), is); };
            const bool moved = any([](const auto& s) { return s.missed; }) &&
                               any([&](const auto& s) { return s.solid != covering_[0].solid; });
            for (std::uint32_t side = moved; side < (moved ? SIDES : 1u); ++side)
                claimed_[step] = std::min(claimed_[step], claim(kernel::missed_on(side)));
        }
        return stretches_of(events, claimed_, shared_.first_hits);
    }

    /// The least region that claims what the covering segments cover, but those that have any of `missed`.
    std::uint32_t claim(std::uint32_t missed) {
        solids_.clear();
        regions_.clear();
        for (const RayEvents::Segment& segment : covering_)
            if (!(segment.missed & missed)) solids_.push_back(segment.solid);
        sort_once(solids_);
        for (const std::uint32_t solid : solids_) shared_.add_regions_of(solid, regions_);
        sort_once(regions_);
        for (const std::uint32_t region : regions_)
            if (walker_.holds(tree_of(region), solids_, shared_.by_partition)) return region;
        return NONE;
    }

    const Tree& tree_of(std::uint32_t region) {
        const Tree& tree = shared_.trees[region];
        if (!shared_.by_tile) return tree;
        const auto found = pruned_trees_.find(region);
        if (found != pruned_trees_.end()) return found->second;
        pruned_ += tree.nodes.size();
        return pruned_trees_.emplace(region, pruned(tree, present_)).first->second;
    }

    const Shared& shared_;
    std::vector<RayEvents> events_;
    std::vector<std::uint32_t> present_, regions_, solids_, claimed_, order_;
    std::vector<RayEvents::Segment> covering_;
    std::map<std::uint32_t, Tree> pruned_trees_;  ///< of the tile
    Walker walker_;
    std::uint64_t pruned_ = 0, partitions_ = 0;
};

}  // namespace

Method pruning() {
    return {
        .name = "pruning",
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
            const double knob = options.knob;
            if (knob != 0 && knob != 1 && knob != 2 && knob != 3)
                throw Error(Status::usage, "pruning: its knob is 0 (off), 1 (per partition), 2 (per tile) or 3 (both)");
            Shared shared{{subject, options}, knob == 1 || knob == 3, knob >= 2};
            for (const PositiveTree& tree : positive_trees(subject.compiled, Grouping::least_height, options.planted))
                shared.trees.push_back(whole(tree));
            return trace_each_ray<Worker>(std::move(shared), options);
        }};
}

}  // namespace csgrt::bench
