// Rossignac 1999: "Blist: a Boolean list formulation of CSG trees".
//
// Theory: the tree in positive form is gone through from leaf to leaf. What a leaf says decides which leaf has to be
// asked next: of A and B, B is asked if A is true, else B is skipped; of A or B the other way round. So each leaf has
// two successors, and nothing is kept but the place in the list. Rossignac keeps it as a label, the name of the leaf
// that is asked next; with the heavier operand on the left, few names are wanted at a time.
//
//   (a - b) + c      leaf  a    b    c
//                    true  b    c    in
//                    false c    in   out        (b is complemented: asked whether the point is outside)
//
// A xor B asks B with its answers exchanged if A is true: B stands twice in the list. With the heavier operand on the
// left a list has at most the square of the tree's leaves, and of a chain twice as many.
//
// Cost: from 1 to all leaves of each region that has a covering solid, for each partition.
// For its speed: as kernel of jumps, a leaf is three words side by side; a leaf's bit comes from a filter and a list in
// registers; regions are tried in their order, and the first that claims ends the search.
// Fails where a region is a large union (the list is read to its end where nothing covers), and where work-items of a
// warp jump apart.
#include <algorithm>
#include <bit>

#include "blists.hpp"
#include "device_method.hpp"
#include "list.hpp"

namespace csgrt::bench {
namespace {

constexpr std::uint32_t complement_bit = 1u << TREE_SHIFT;
constexpr std::size_t most_leaves = std::size_t{1} << 26;

/// Writes a tree backwards: successors first. Their numbers count from the end.
class BlistWriter {
public:
    explicit BlistWriter(const PositiveTree& tree) : tree_(tree) {}

    /// Returns where the node's list begins. The right operand is the lighter one: the recursion is as deep as its
    /// leaves' logarithm.
    std::uint32_t write(std::uint32_t number, std::uint32_t on_true, std::uint32_t on_false) {
        while (tree_.nodes[number].gate != Gate::leaf) {
            const PositiveTree::Node& node = tree_.nodes[number];
            if (node.gate == Gate::intersection) {
                on_true = write(node.right, on_true, on_false);
            } else if (node.gate == Gate::union_) {
                on_false = write(node.right, on_true, on_false);
            } else {
                const std::uint32_t same = write(node.right, on_true, on_false);
                on_true = write(node.right, on_false, on_true);
                on_false = same;
            }
            number = node.left;
        }
        const PositiveTree::Node& leaf = tree_.nodes[number];
        if (leaves.size() == most_leaves) throw Error(Status::usage, "Blist: xor makes a list of over 2^26 leaves");
        leaves.push_back({leaf.left, leaf.complement, on_true, on_false});
        return static_cast<std::uint32_t>(leaves.size() - 1);
    }

    std::vector<BlistLeaf> leaves;

private:
    const PositiveTree& tree_;
};

std::unique_ptr<Tracer> prepare(const Subject& subject, const TraceOptions& options) {
    std::vector<std::uint32_t> firsts, words;
    std::size_t most_labels = 1, leaf_count = 0;
    for (const PositiveTree& tree : positive_trees(subject.compiled, Grouping::heavy_left, options.planted)) {
        const std::vector<BlistLeaf> leaves = blist_of(tree);
        const auto base = static_cast<std::uint32_t>(leaf_count);
        most_labels = std::max(most_labels, labels(leaves));
        leaf_count += leaves.size();
        if (leaf_count > most_leaves) throw Error(Status::usage, "Blist: the lists have over 2^26 leaves");
        const auto placed = [&](std::uint32_t next) { return next >= BlistLeaf::out ? next : base + next; };
        for (const BlistLeaf& leaf : leaves)
            words.insert(words.end(), {leaf.solid | (leaf.complement ? complement_bit : 0), placed(leaf.on_true),
                                       placed(leaf.on_false)});
        firsts.push_back(leaves.empty() ? BlistLeaf::out : base);
    }
    DeviceMethod method{.name = "Blist",
                        .kernel = "evaluate_blist",
                        .tables = {std::move(firsts), std::move(words)},
                        .figures = {{"bits a label", static_cast<double>(std::bit_width(most_labels - 1))},
                                    {"leaves in lists", static_cast<double>(leaf_count)}}};
    return trace_on_device(subject, options, std::move(method));
}

}  // namespace

std::vector<BlistLeaf> blist_of(const PositiveTree& tree) {
    BlistWriter writer(tree);
    if (!tree.nodes.empty()) writer.write(tree.root(), BlistLeaf::in, BlistLeaf::out);
    // The writer's order turned round, so that successors stand behind. The root's list begins with its last leaf.
    std::reverse(writer.leaves.begin(), writer.leaves.end());
    const auto last = static_cast<std::uint32_t>(writer.leaves.size() - 1);
    for (BlistLeaf& leaf : writer.leaves)
        for (std::uint32_t* next : {&leaf.on_true, &leaf.on_false})
            if (*next < BlistLeaf::out) *next = last - *next;
    return std::move(writer.leaves);
}

std::size_t labels(const std::vector<BlistLeaf>& leaves) {
    const std::size_t count = leaves.size();
    std::vector<std::size_t> teller(count + 2, count);  // of each place, in, out: the first leaf that tells it
    const auto place = [&](std::uint32_t next) {
        return next == BlistLeaf::in ? count : next == BlistLeaf::out ? count + 1 : next;
    };
    for (std::size_t i = count; i-- > 0;) teller[place(leaves[i].on_true)] = teller[place(leaves[i].on_false)] = i;
    std::vector<std::size_t> begun(count + 1), ended(count + 1);
    for (std::size_t p = 1; p < count + 2; ++p) {
        if (teller[p] == count) continue;
        ++begun[teller[p]];
        if (p < count) ++ended[p];
    }
    std::size_t now = 0, most = 0;
    for (std::size_t i = 0; i < count; ++i) {
        now += begun[i];
        now -= ended[i];
        most = std::max(most, now);
    }
    return most;
}

Method blist() {
    return {.name = "Blist",
            .source = "Rossignac 1999",
            .about =
                "Trees in positive form become lists of leaves with two successors, and a partition jumps from "
                "leaf to leaf. The heavier operand stands on the left, for small labels. A xor doubles its "
                "lighter operand.",
            .breaks =
                "deep_trees: long lists of which all leaves are asked where a union is not covered, and xor "
                "doubles operands. No family makes it wrong.",
            .knob = "",
            .first_hits = false,
            .on_device = true,
            .prepare = prepare};
}

}  // namespace csgrt::bench
