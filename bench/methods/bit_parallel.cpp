// Jansen 1991, bit-parallel: "Depth-order point classification techniques for CSG display algorithms".
//
// Theory: all gates of one level of a tree are evaluated by one operation on words: the leaves' bits, and the same
// shifted, are joined by and, or and xor where masks say so (kernels/bit_parallel.cl has a picture). A tree of 32
// leaves takes 5 steps.
//
// Cost: log2(leaves) steps a word. A complete tree has 2^height leaves, so trees are flattened first by associativity;
// and those that stay deep (a difference in a union in a difference ...) are cut into pieces of at most 5 levels, from
// the leaves up, a word each. What words lack in width costs a word more, and what they lack in depth a word for
// each 5 levels.
// For its speed: leaf bits are set from the covering solids, which know where they stand, or asked leaf by leaf,
// whichever are fewer; padding is an or with 0 and takes no mask; pieces' results stay in registers.
// Fails where trees are large: all pieces of a region are evaluated for each partition, whatever covers it.
#include <algorithm>

#include "device_method.hpp"
#include "list.hpp"

namespace csgrt::bench {
namespace {

// As in kernels/bit_parallel.cl.
constexpr std::uint32_t piece_words = 15, most_results = 128, most_levels = 5;

/// Cuts one tree into pieces.
class Pieces {
public:
    explicit Pieces(const PositiveTree& tree) : tree_(tree), nodes_(tree.nodes.size()) {
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
            if (tree.nodes[i].gate == Gate::leaf) continue;
            std::uint32_t left = tree.nodes[i].left, right = tree.nodes[i].right;
            if (std::max(nodes_[left].levels, nodes_[right].levels) == most_levels)
                for (const std::uint32_t operand : {left, right}) cut(operand);
            // The operand whose pieces need more room for results comes first.
            if (needed(right, left) < needed(left, right)) std::swap(left, right);
            nodes_[i].left = left;
            nodes_[i].right = right;
            nodes_[i].levels = std::max(nodes_[left].levels, nodes_[right].levels) + 1;
            nodes_[i].needed = needed(left, right);
            nodes_[i].results = nodes_[left].results + nodes_[right].results;
        }
        if (nodes_.back().needed > most_results)
            throw Error(Status::usage, "bit-parallel: a tree keeps more than 128 results of its pieces at a time");
    }

    /// Appends the pieces' words, those that are needed first, the leaves' places to those of their solids, and the
    /// pieces' solids.
    void write(std::vector<std::uint32_t>& words, std::vector<std::vector<std::uint32_t>>& places,
               std::vector<std::uint32_t>& solids) const {
        std::vector<std::uint32_t> order, rest{tree_.root()}, leaves;
        while (!rest.empty()) {  // backwards: a piece, then those it needs from right to left
            order.push_back(rest.back());
            rest.pop_back();
            for_leaves(order.back(), [&](std::uint32_t node, std::uint32_t) {
                if (nodes_[node].is_cut) rest.push_back(node);
            });
        }
        std::reverse(order.begin(), order.end());
        for (const std::uint32_t root : order) {
            const auto piece = static_cast<std::uint32_t>(words.size() / piece_words);
            if (piece >> 27) throw Error(Status::usage, "bit-parallel: the trees have over 2^27 pieces");
            const std::size_t first = words.size();
            words.resize(first + piece_words);
            std::uint32_t* const w = words.data() + first;
            w[2] = levels_of(root);
            w[14] = static_cast<std::uint32_t>(solids.size());
            for_leaves(
                root,
                [&](std::uint32_t node, std::uint32_t bit) {
                    const PositiveTree::Node& leaf = tree_.nodes[node];
                    if (nodes_[node].is_cut) {
                        w[1] |= 1u << bit;
                        return;
                    }
                    if (leaf.complement) w[0] |= 1u << bit;
                    w[13] |= 1u << bit;
                    places[leaf.left].push_back(piece << 5 | bit);
                    solids.push_back(leaf.left);
                },
                [&](std::uint32_t node, std::uint32_t bit) {
                    const std::uint32_t level = levels_of(node);
                    if (tree_.nodes[node].gate == Gate::intersection) w[1 + 2 * level] |= 1u << bit;
                    if (tree_.nodes[node].gate == Gate::xor_) w[2 + 2 * level] |= 1u << bit;
                });
        }
    }

private:
    struct Node {
        std::uint32_t left = 0, right = 0;
        std::uint32_t levels = 0;               ///< of gates, down to leaves and pieces' results; 0 once it is cut off
        std::uint32_t needed = 0, results = 0;  ///< bits of results: at most at a time, and when they are all there
        bool is_cut = false;
    };

    void cut(std::uint32_t node) {
        if (nodes_[node].levels < most_levels) return;
        nodes_[node].is_cut = true;
        nodes_[node].levels = 0;
        nodes_[node].results = 1;
    }
    std::uint32_t needed(std::uint32_t first, std::uint32_t second) const {
        return std::max({nodes_[first].needed, nodes_[first].results + nodes_[second].needed,
                         nodes_[first].results + nodes_[second].results});
    }
    /// Of a node by itself, whether it is cut off or not.
    std::uint32_t levels_of(std::uint32_t node) const {
        return nodes_[node].is_cut ? most_levels : nodes_[node].levels;
    }

    /// Calls leaf(node, bit) for what is at the ends of a piece, from left to right, and gate(node, bit) for its gates.
    template <class Leaf, class GateCall>
    void for_leaves(std::uint32_t root, const Leaf& leaf, const GateCall& gate) const {
        struct Place {
            std::uint32_t node, bit;
        };
        std::vector<Place> rest{{root, (1u << levels_of(root)) - 1}};
        while (!rest.empty()) {
            const Place place = rest.back();
            rest.pop_back();
            const bool is_root = place.node == root;
            if (tree_.nodes[place.node].gate == Gate::leaf || (nodes_[place.node].is_cut && !is_root)) {
                leaf(place.node, place.bit);
                continue;
            }
            gate(place.node, place.bit);
            const std::uint32_t half = 1u << (levels_of(place.node) - 1);
            rest.push_back({nodes_[place.node].right, place.bit});
            rest.push_back({nodes_[place.node].left, place.bit - half});
        }
    }
    template <class Leaf>
    void for_leaves(std::uint32_t root, const Leaf& leaf) const {
        for_leaves(root, leaf, [](std::uint32_t, std::uint32_t) {});
    }

    const PositiveTree& tree_;
    std::vector<Node> nodes_;
};

std::unique_ptr<Tracer> prepare(const Subject& subject, const TraceOptions& options) {
    std::vector<std::uint32_t> firsts{0}, words, solids;
    std::vector<std::vector<std::uint32_t>> places(subject.compiled.solids.size());
    for (const PositiveTree& tree : positive_trees(subject.compiled, Grouping::least_height, options.planted)) {
        if (!tree.nodes.empty()) Pieces(tree).write(words, places, solids);
        firsts.push_back(static_cast<std::uint32_t>(words.size() / piece_words));
    }
    for (std::vector<std::uint32_t>& list : places) std::sort(list.begin(), list.end());
    const double pieces = firsts.back(), regions = static_cast<double>(firsts.size() - 1);
    ListTable leaves = ListTable::of(places);
    DeviceMethod method{.name = "bit-parallel",
                        .kernel = "evaluate_bit_parallel",
                        .tables = {std::move(firsts), std::move(words), std::move(leaves.firsts),
                                   std::move(leaves.values), std::move(solids)},
                        .figures = {{"words a region", pieces / std::max(regions, 1.0)}}};
    return trace_on_device(subject, options, std::move(method));
}

}  // namespace

Method bit_parallel() {
    return {.name = "bit-parallel",
            .source = "Jansen 1991",
            .about =
                "All gates of a level are evaluated by one operation on words. Chains are flattened first; "
                "trees that are deeper than 5 levels are cut into words. Leaf bits are set from the covering "
                "solids, which know their places, or asked one by one, whichever are fewer.",
            .breaks =
                "deep_trees: chains of differing operators cannot be flattened, so every partition evaluates a "
                "word for each 5 nodes. No family makes it wrong.",
            .knob = "",
            .first_hits = false,
            .on_device = true,
            .prepare = prepare};
}

}  // namespace csgrt::bench
