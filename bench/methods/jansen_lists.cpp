// Jansen 1991, one list, first list and sequence list: "Depth-order point classification techniques for CSG display
// algorithms"; thesis section 2.1.1 and figure 2.3.
//
// Theory: neighbouring rays mostly cross the same surfaces in the same order, and then what they find is the same. So a
// region keeps the crossings of earlier rays, each with its verdict: whether the region is entered or left there. A ray
// reads the verdicts while its own crossings are those of the list. From the first difference on it classifies, with a
// status tree, and writes what it finds into the list.
//
//   ray 1   a in   b in   a out  b out        list  a+ in   b+ out  a- out  b- out     (a - b)
//   ray 2   a in   b in   a out  b out        all four are read
//   ray 3   a in   a out                      the first is read; a- is classified, and the list is a+ in, a- out
//
//   one list        the last ray's
//   first list      a list for each first crossing
//   sequence list   all sequences, as a tree of crossings whose root is the empty sequence
//
// The thesis names the first list without describing it; a list for each first crossing is how it is read here. A
// crossing is a solid, in or out, and whether it lies at the distance of the one before: equal prefixes then have equal
// verdicts, and nothing can be wrong.
//
// Cost: a comparison a crossing that is read, and the status tree's walk for the others, after the solids that cover
// the place of the first difference have been put into the tree. Memory: the sequence list grows with what is seen.
// Prediction: of a picture's crossings more than nine tenths are read; time is not gained, as the status tree's walk is
// short, and finding the surfaces and sorting them costs more than both. Broken by deep_trees, depth and all scenes
// whose rays are no neighbours: the share read falls to a tenth, and the lists only cost.
#include <unordered_map>

#include "device_method.hpp"
#include "each_ray.hpp"
#include "list.hpp"
#include "ray_events.hpp"

namespace csgrt::bench {
namespace {

enum class Kept { nothing, one_list, first_list, sequence_list };

/// A region's tree with a bit a node, and the way up.
struct StatusTree {
    static constexpr std::uint32_t none = 0xffffffff;
    struct Leaf {
        std::uint32_t solid, node;
    };
    PositiveTree tree;
    std::vector<std::uint32_t> above;
    std::vector<std::uint8_t> empty;  ///< by node: its value where no solid is
    std::vector<Leaf> leaves;         ///< by ascending solid

    explicit StatusTree(PositiveTree made)
        : tree(std::move(made)), above(tree.nodes.size(), none), empty(tree.nodes.size()) {
        for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
            const PositiveTree::Node& node = tree.nodes[i];
            if (node.gate == Gate::leaf) {
                empty[i] = node.complement;
                leaves.push_back({node.left, i});
            } else {
                above[node.left] = above[node.right] = i;
                empty[i] = value_of(node.gate, empty[node.left], empty[node.right]);
            }
        }
        std::stable_sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) { return a.solid < b.solid; });
    }
};

struct Shared : EventScene {
    Kept kept;
    std::vector<StatusTree> trees = {};  ///< one a region
};

class Worker {
public:
    explicit Worker(const Shared& shared)
        : shared_(shared),
          crossings_(shared.trees.size()),
          values_(shared.trees.size()),
          covers_(shared.rays.scene().solids.size()),
          sequence_values_(shared.trees.size()) {}

    void trace(const Ray& ray, Answer& answer) {
        events_.find(shared_.rays, ray);
        answer.stretches = stretches_of(
            events_, owners_.find(events_, [this](auto missed, auto& claimed) { classify(missed, claimed); }),
            shared_.first_hits);
    }
    Counts counts() const {
        return {{"verdicts read, share of crossings", {read_, std::max<std::uint64_t>(all_, 1)}},
                {"nodes visited a ray", {visited_}}};
    }

private:
    struct Crossing {
        std::uint32_t event;
        std::uint32_t key;  ///< solid << 2, 2 if it is left, 1 if the distance is that of the crossing before
        bool operator<(const Crossing& other) const {
            return std::pair(event, key) < std::pair(other.event, other.key);
        }
    };
    struct Entry {
        std::uint32_t key;
        bool inside;  ///< of the region, behind the crossing
    };
    static constexpr std::uint32_t is_out = 2, at_the_same = 1;
    /// A sequence list of so many crossings is not made longer; a worker then has 200 MB.
    static constexpr std::size_t most_kept = 1u << 22;

    /// Of each step the least region that claims it.
    void classify(std::uint32_t missed, std::vector<std::uint32_t>& claimed) {
        claimed.assign(events_.steps(), NONE);
        regions_.clear();
        for (const RayEvents::Segment& segment : events_.segments) {
            if (segment.missed & missed) continue;
            for (const std::uint32_t region : shared_.regions_of[segment.solid]) {
                if (crossings_[region].empty()) regions_.push_back(region);
                crossings_[region].push_back({segment.in, segment.solid << 2});
                crossings_[region].push_back({segment.out, segment.solid << 2 | is_out});
            }
        }
        for (const std::uint32_t region : regions_) {
            std::vector<Crossing>& crossings = crossings_[region];
            std::sort(crossings.begin(), crossings.end());
            for (std::size_t i = 1; i < crossings.size(); ++i)
                if (crossings[i].event == crossings[i - 1].event) crossings[i].key |= at_the_same;
            verdicts_.resize(crossings.size());
            all_ += crossings.size();
            if (shared_.kept == Kept::sequence_list)
                by_sequences(region, crossings);
            else
                by_list(region, crossings);
            for (std::size_t i = 0; i + 1 < crossings.size(); ++i)
                if (verdicts_[i])
                    for (std::uint32_t step = crossings[i].event; step < crossings[i + 1].event; ++step)
                        claimed[step] = std::min(claimed[step], region);
            crossings.clear();
        }
    }

    /// Compares with the region's list, which is one, or one for each first crossing.
    void by_list(std::uint32_t region, const std::vector<Crossing>& crossings) {
        const std::uint32_t first = shared_.kept == Kept::first_list ? crossings[0].key : 0;
        std::vector<Entry>& list = lists_[std::uint64_t{region} << 32 | first];
        std::size_t same = 0;
        for (; same < std::min(list.size(), crossings.size()) && list[same].key == crossings[same].key; ++same)
            verdicts_[same] = list[same].inside;
        read_ += same;
        if (same == crossings.size()) return;
        walk(region, crossings, same);
        list.resize(same);
        if (shared_.kept == Kept::nothing) return;
        for (std::size_t i = same; i < crossings.size(); ++i) list.push_back({crossings[i].key, verdicts_[i] != 0});
    }

    /// The tree of all sequences. Its first nodes are the regions' empty sequences.
    void by_sequences(std::uint32_t region, const std::vector<Crossing>& crossings) {
        const auto place = [](std::size_t node, std::uint32_t key) { return std::uint64_t{node} << 32 | key; };
        std::size_t node = region, same = 0;
        for (; same < crossings.size(); ++same) {
            const auto next = behind_.find(place(node, crossings[same].key));
            if (next == behind_.end()) break;
            node = next->second;
            verdicts_[same] = sequence_values_[node];
        }
        read_ += same;
        if (same == crossings.size()) return;
        walk(region, crossings, same);
        for (std::size_t i = same; i < crossings.size() && sequence_values_.size() < most_kept; ++i) {
            const std::uint64_t at = place(node, crossings[i].key);
            node = sequence_values_.size();
            behind_[at] = static_cast<std::uint32_t>(node);
            sequence_values_.push_back(verdicts_[i]);
        }
    }

    /// The verdicts of the crossings from `first` on, by the status tree.
    void walk(std::uint32_t region, const std::vector<Crossing>& crossings, std::size_t first) {
        const StatusTree& tree = shared_.trees[region];
        std::vector<std::uint8_t>& values = values_[region];
        if (values.empty()) values = tree.empty;
        covering_.clear();
        for (std::size_t i = 0; i < crossings.size(); ++i) {
            if (i == first)
                for (const std::uint32_t solid : covering_) flip(tree, values, solid);
            const std::uint32_t solid = crossings[i].key >> 2;
            const bool leaves = crossings[i].key & is_out;
            const bool changes = leaves ? --covers_[solid] == 0 : covers_[solid]++ == 0;
            if (changes && i >= first) flip(tree, values, solid);
            if (changes && i < first && !leaves) covering_.push_back(solid);
            if (changes && i < first && leaves) std::erase(covering_, solid);
            if (i >= first) verdicts_[i] = values.back();
        }
        // All solids are left now, and the values are those of empty space again.
    }

    void flip(const StatusTree& tree, std::vector<std::uint8_t>& values, std::uint32_t solid) {
        auto leaf = std::lower_bound(tree.leaves.begin(), tree.leaves.end(), solid,
                                     [](const StatusTree::Leaf& l, std::uint32_t s) { return l.solid < s; });
        for (; leaf != tree.leaves.end() && leaf->solid == solid; ++leaf) {
            values[leaf->node] ^= 1;
            for (std::uint32_t i = tree.above[leaf->node]; i != StatusTree::none; i = tree.above[i]) {
                const PositiveTree::Node& node = tree.tree.nodes[i];
                const bool value = value_of(node.gate, values[node.left], values[node.right]);
                ++visited_;
                if (value == (values[i] != 0)) break;
                values[i] = value;
            }
        }
    }

    const Shared& shared_;
    RayEvents events_;
    StepOwners owners_;
    std::vector<std::vector<Crossing>> crossings_;  ///< by region
    std::vector<std::vector<std::uint8_t>> values_;
    std::vector<std::uint32_t> regions_, covering_, covers_;
    std::vector<std::uint8_t> verdicts_;  ///< of a region's crossings
    std::unordered_map<std::uint64_t, std::vector<Entry>> lists_;
    std::unordered_map<std::uint64_t, std::uint32_t> behind_;  ///< by a sequence and the crossing that follows
    std::vector<std::uint8_t> sequence_values_;                ///< by sequence: its last verdict
    std::uint64_t read_ = 0, all_ = 0, visited_ = 0;
};

}  // namespace

Method jansen_lists() {
    return {
        .name = "Jansen's lists",
        .source = "Jansen 1991",
        .about =
            "Each region keeps the crossings of earlier rays with their verdicts, and a ray reads them while its own "
            "crossings are the same; then it walks a status tree. One list: the last ray's; first list: one for each "
            "first crossing; sequence list: all sequences as a tree.",
        .breaks =
            "deep_trees and depth, whose rays are no neighbours: little is read, and the lists only cost. No family "
            "makes it wrong.",
        .knob = "0 no list, 1 one list, 2 first list, 3 sequence list",
        .knob_values = {0, 1, 2, 3},
        .prepare = [](const Subject& subject, const TraceOptions& options) {
            const auto kept = static_cast<Kept>(options.knob);
            if (!(options.knob >= 0 && options.knob <= 3) || static_cast<double>(kept) != options.knob)
                throw Error(
                    Status::usage,
                    "Jansen's lists: the knob is 0 (no list), 1 (one list), 2 (first list) or 3 (sequence list)");
            Shared shared{{subject, options}, kept};
            for (PositiveTree& tree : positive_trees(subject.compiled, Grouping::least_height, options.planted))
                shared.trees.emplace_back(std::move(tree));
            return trace_each_ray<Worker>(std::move(shared), options);
        }};
}

}  // namespace csgrt::bench
