// Jansen 1991, bit-sequential: "Depth-order point classification techniques for CSG display algorithms".
//
// Theory: whether a point is in a region follows from one bit a solid. The tree is gone through in postorder with a
// stack of bits: a leaf pushes its bit, a gate takes two and pushes one. csgrt's own kernel 4 (scan_term in
// kernels/boolean/claim.h) is this with shortcuts: only terms that a covering solid starts, filters, roles. Here there
// is none of these, so the two can be compared.
//
// Cost: every node of every region that has a covering solid, for each partition.
// For its speed: the stack is one register, because operands with more leaves come first; the nodes are single words in
// order; a leaf's bit comes from a filter and a list in registers; regions are tried in their order, and the first that
// claims ends the search.
// Fails where trees are large.
#include "device_method.hpp"
#include "list.hpp"

namespace csgrt::bench {
namespace {

constexpr std::uint32_t gate_shift = 30, complement_bit = 1u << TREE_SHIFT;

/// Left before right before the gate.
void write_postorder(const PositiveTree& tree, std::vector<std::uint32_t>& words) {
    if (tree.nodes.empty()) return;
    // Backwards: the gate, the right operand, the left.
    const std::size_t first = words.size();
    std::vector<std::uint32_t> rest{tree.root()};
    while (!rest.empty()) {
        const PositiveTree::Node& node = tree.nodes[rest.back()];
        rest.pop_back();
        if (node.gate == Gate::leaf) {
            words.push_back(node.left | (node.complement ? complement_bit : 0));
        } else {
            words.push_back(static_cast<std::uint32_t>(node.gate) << gate_shift);
            rest.push_back(node.left);
            rest.push_back(node.right);
        }
    }
    std::reverse(words.begin() + static_cast<std::ptrdiff_t>(first), words.end());
}

std::unique_ptr<Tracer> prepare(const Subject& subject, const TraceOptions& options) {
    ListTable code;
    for (const PositiveTree& tree : positive_trees(subject.compiled, Grouping::heavy_left, options.planted)) {
        write_postorder(tree, code.values);
        code.end_list();
    }
    DeviceMethod method{.name = "bit-sequential",
                        .kernel = "evaluate_bit_sequential",
                        .tables = {std::move(code.firsts), std::move(code.values)},
                        .figures = {}};
    return trace_on_device(subject, options, std::move(method));
}

}  // namespace

Method bit_sequential() {
    return {.name = "bit-sequential",
            .source = "Jansen 1991",
            .about =
                "Each partition goes through the trees in postorder with a stack of bits, without any shortcut. "
                "csgrt's own scan of terms is this with shortcuts. The stack is one register, since operands "
                "with more leaves come first.",
            .breaks = "deep_trees: every partition reads every node of the region. No family makes it wrong.",
            .knob = "",
            .first_hits = false,
            .on_device = true,
            .prepare = prepare};
}

}  // namespace csgrt::bench
