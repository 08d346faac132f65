// Jansen 1991, status tree: "Depth-order point classification techniques for CSG display algorithms".
//
// Theory: neighbouring partitions of a ray differ in few solids. The tree keeps a bit a node. Where a segment begins
// or ends, its leaves change, and each change walks up until a gate's value stays what it was.
//
// Cost: O(height) at most for each end and each leaf of its solid; mostly the walk ends after a step or two. Memory: a
// bit a node for each ray that is underway.
// For its speed: chains are flattened first, so the way up is short; a node is one word with its gate and the node
// above; brothers stand side by side; the bits say what differs from the empty state, so that all memory begins at 0;
// the least region that claims is kept, and looked for only where it is lost.
// Fails where scenes are large: 10^6 nodes take 125 KB a ray, so few rays are underway; and where a work-item a ray is
// too few for a GPU.
#include <algorithm>

#include "device_method.hpp"
#include "list.hpp"

namespace csgrt::bench {
namespace {

constexpr std::uint32_t above_shift = 30;

std::unique_ptr<Tracer> prepare(const Subject& subject, const TraceOptions& options) {
    std::vector<std::uint32_t> above, initial, roots;
    std::vector<std::vector<std::uint32_t>> leaves(subject.compiled.solids.size());
    const auto add_pair = [&] {
        const auto pair = static_cast<std::uint32_t>(above.size());
        if (pair >> above_shift) throw Error(Status::usage, "status tree: the trees have over 2^30 nodes");
        above.resize(pair + 2);
        return pair;
    };
    for (const PositiveTree& tree : positive_trees(subject.compiled, Grouping::least_height, options.planted)) {
        std::vector<std::uint32_t> number(tree.nodes.size());
        std::vector<bool> value(tree.nodes.size());
        roots.push_back(add_pair());
        if (tree.nodes.empty()) continue;
        above[roots.back()] = static_cast<std::uint32_t>(roots.size() - 1);
        number.back() = roots.back();
        for (std::size_t i = tree.nodes.size(); i-- > 0;) {
            const PositiveTree::Node& node = tree.nodes[i];
            if (node.gate == Gate::leaf) {
                leaves[node.left].push_back(number[i]);
                continue;
            }
            const std::uint32_t pair = add_pair();
            number[node.left] = pair;
            number[node.right] = pair + 1;
            above[pair] = above[pair + 1] = static_cast<std::uint32_t>(node.gate) << above_shift | number[i];
        }
        initial.resize((above.size() + 31) / 32);
        for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
            const PositiveTree::Node& node = tree.nodes[i];
            value[i] =
                node.gate == Gate::leaf ? node.complement : value_of(node.gate, value[node.left], value[node.right]);
            initial[number[i] / 32] |= static_cast<std::uint32_t>(value[i]) << number[i] % 32;
        }
    }
    initial.resize((above.size() + 31) / 32);
    const auto words = static_cast<std::uint32_t>(initial.size());
    ListTable places = ListTable::of(leaves);
    DeviceMethod method{.name = "status tree",
                        .kernel = "evaluate_status_tree",
                        .tables = {std::move(above),
                                   std::move(initial),
                                   std::move(places.firsts),
                                   std::move(places.values),
                                   {words},
                                   std::move(roots)},
                        .item_a_ray = true,
                        .ray_words = words,
                        .figures = {}};
    return trace_on_device(subject, options, std::move(method));
}

}  // namespace

Method status_tree() {
    return {.name = "status tree",
            .source = "Jansen 1991",
            .about =
                "A bit a node is kept along the ray. An end flips its solid's leaves, and each flip walks up "
                "until a gate stays as it was. Chains are flattened first; a node is one word; brothers stand "
                "side by side.",
            .breaks =
                "deep_trees: the walks up are as long as chains of differing operators are deep, and a solid "
                "that stands in a tree 1000 times flips 1000 leaves. No family makes it wrong.",
            .knob = "",
            .first_hits = false,
            .on_device = true,
            .prepare = prepare};
}

}  // namespace csgrt::bench
