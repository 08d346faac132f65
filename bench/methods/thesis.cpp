// Domingues 2017, the evaluation of the thesis (sections 3.3.4 to 3.3.6), to switch one thing of it at a time.
//
// Theory: a work-item is a ray and looks at its partitions in order. The segments of a partition are a bit array,
// walked by clz. They give a table of regions, a bit array, too, by lists of each primitive's regions. Each region of
// the table is evaluated: not at all if its tree has only unions, else depth first, with early out. First hits end at
// the first partition that a region holds. thesis.hpp has the switches.
//
// Differences from the thesis: of overlapping regions the first owns the partition, whatever owned the one before;
// rays in faces are moved to four sides, as csgrt does (boolean/claim.h); differences are intersections with
// complements, and the operand of fewer leaves comes first, so that a stack of 30 entries suffices.
//
// Cost: for each partition its segments, the table of regions, and of each region in it the leaves that early out does
// not skip, times the segments.
// Predicted, before it was measured: the list of regions a primitive is most of havoc's and goliath's time; bit arrays
// and lists differ by less than a tenth; early out halves the time of havoc and changes goliath by little; unions save
// less than a tenth; groups of 32 to 256 differ by less than a tenth.
// Fails where trees are large, and where long rays keep a group waiting.
#include "thesis.hpp"

#include <algorithm>
#include <iterator>

#include "device_method.hpp"
#include "list.hpp"

namespace csgrt::bench {
namespace {

constexpr std::uint32_t gate_shift = 30, complement_bit = 1u << TREE_SHIFT, own_words = 256;

/// Depth first; the right operand, which has fewer leaves, comes first.
void write_depth_first(const PositiveTree& tree, std::vector<std::uint32_t>& words) {
    if (tree.nodes.empty()) return;
    struct Operand {
        std::uint32_t node, gate;  ///< gate: the word that wants this operand's place
    };
    std::vector<Operand> rest{{tree.root(), NONE}};
    while (!rest.empty()) {
        const Operand next = rest.back();
        rest.pop_back();
        const PositiveTree::Node& node = tree.nodes[next.node];
        const auto place = static_cast<std::uint32_t>(words.size());
        if (place >> gate_shift) throw Error(Status::usage, "thesis: the trees have over 2^30 words");
        if (next.gate != NONE) words[next.gate] |= place;
        if (node.gate == Gate::leaf) {
            words.push_back(node.left | (node.complement ? complement_bit : 0));
        } else {
            words.push_back(static_cast<std::uint32_t>(node.gate) << gate_shift);
            rest.push_back({node.left, place});
            rest.push_back({node.right, NONE});
        }
    }
}

bool has_only_unions(const PositiveTree& tree) {
    return std::ranges::all_of(tree.nodes, [](const PositiveTree::Node& node) {
        return node.gate == Gate::union_ || (node.gate == Gate::leaf && !node.complement);
    });
}

std::unique_ptr<Tracer> prepare(const Subject& subject, const TraceOptions& options) {
    if (options.knob < 0 || options.knob >= static_cast<double>(std::size(thesis_switches)))
        throw Error(Status::usage, "thesis: there is no such switch; bench/methods/thesis.hpp has them, from 0 on");
    const ThesisSwitch& chosen = thesis_switches[static_cast<std::size_t>(options.knob)];
    ListTable code;
    std::vector<std::uint32_t> only_unions;
    for (const PositiveTree& tree : positive_trees(subject.compiled, Grouping::heavy_left, options.planted)) {
        write_depth_first(tree, code.values);
        code.end_list();
        only_unions.push_back(has_only_unions(tree));
    }
    const auto regions = static_cast<std::uint32_t>(only_unions.size());
    const std::uint32_t table =
        std::string_view(chosen.kernel) == "thesis_lists_regions" ? regions : (regions + 31) / 32;
    const auto unions = static_cast<double>(std::ranges::count(only_unions, 1u));
    DeviceMethod method{.name = "thesis",
                        .kernel = chosen.kernel,
                        .tables = {std::move(code.firsts),
                                   std::move(code.values),
                                   std::move(only_unions),
                                   {regions, table, options.first_hits ? 1u : 0u}},
                        .item_a_ray = true,
                        .group = chosen.group,
                        .ray_words = table + own_words,
                        .figures = {{"regions of unions alone", unions}}};
    return trace_on_device(subject, options, std::move(method));
}

}  // namespace

Method thesis() {
    Method method{
        .name = "thesis",
        .source = "Domingues 2017",
        .about =
            "A work-item a ray: bit arrays of segments and regions, walked by clz; lists of each primitive's "
            "regions; trees depth first with early out; unions are not walked. A switch changes one of these.",
        .breaks = "deep_trees: each leaf goes through the partition's segments. No family makes it wrong.",
        .knob = "switch (bench/methods/thesis.hpp)",
        .on_device = true,
        .on_chart = false,
        .prepare = prepare};
    for (std::size_t i = 0; i < std::size(thesis_switches); ++i) method.knob_values.push_back(static_cast<double>(i));
    return method;
}

}  // namespace csgrt::bench
