// Roth 1982: "Ray casting for modeling solids".
//
// Theory: a ray's classification against a solid is a sorted list of the intervals in which it is inside. The list of a
// composite comes from the lists of its operands: they are merged in order, the operator's truth table says what each
// piece is, and equal neighbours are joined. So the tree is walked once for all intervals of a ray, from the root down
// and back, a list a level.
//
//   A        |---------|            toggles  1 4
//   B             |---------|                2 5
//   A - B    |----|                          1 2
//
// Roth compares distances, where two surfaces that are one may come in any order. Here the ray's ends are first sorted
// into events (ray_events.hpp), once, and the lists hold the events' numbers: equal surfaces have equal numbers.
// A list is the events at which the status toggles. Overlaps: the region of the least number has the step.
//
// Cost: O(nodes + ends log ends) for each region that the ray meets; but a chain of binary nodes whose n operands all
// are hit merges a growing list n times.
// For its speed: regions of which the ray meets no solid are left out; Roth's early outs (an operand that cannot matter
// is not walked: the rest of an intersection or a difference whose first operand is empty); an empty operand of a union
// costs no merge; the operands of a wide union are merged two by two; lists lie in one stack of numbers, without an
// allocation.
// Fails where trees are large: a region of 10^5 nodes is walked whole for one hit solid.
#include "each_ray.hpp"
#include "list.hpp"
#include "ray_events.hpp"

namespace csgrt::bench {
namespace {

/// A region's tree from the root down: operands stand behind their operator.
struct Node {
    Operator op;
    std::uint32_t operands;  ///< leaf: the solid
    std::uint32_t end;       ///< the node behind the last of the subtree
};

std::vector<Node> from_the_root(const FlatTree& tree, bool planted) {
    // In postfix order a subtree's size tells where its operands begin.
    const std::size_t count = tree.nodes.size();
    std::vector<std::uint32_t> size(count, 1);
    std::vector<std::vector<std::uint32_t>> operands(count);
    std::vector<std::uint32_t> stack;
    for (std::uint32_t i = 0; i < count; ++i) {
        const FlatTree::Node& node = tree.nodes[i];
        if (node.op != Operator::leaf) {
            operands[i].assign(stack.end() - node.arity, stack.end());
            stack.resize(stack.size() - node.arity);
            for (const std::uint32_t operand : operands[i]) size[i] += size[operand];
        }
        stack.push_back(i);
    }
    std::vector<Node> nodes;
    nodes.reserve(count);
    while (!stack.empty()) {
        const std::uint32_t i = stack.back();
        stack.pop_back();
        const FlatTree::Node& node = tree.nodes[i];
        const auto end = static_cast<std::uint32_t>(nodes.size() + size[i]);
        const Operator op = planted && node.op == Operator::difference ? Operator::union_ : node.op;
        nodes.push_back({op, op == Operator::leaf ? node.solid : node.arity, end});
        stack.insert(stack.end(), operands[i].rbegin(), operands[i].rend());
    }
    return nodes;
}

/// A ray's intervals in each of its solids.
struct SolidLists {
    struct Entry {
        std::uint32_t solid, first, last;  ///< into `toggles`
    };
    std::vector<Entry> entries;  ///< by ascending solid
    std::vector<std::uint32_t> toggles;

    /// Of the segments that have none of `missed`.
    void fill(const RayEvents& events, std::uint32_t missed) {
        entries.clear();
        toggles.clear();
        for (std::size_t i = 0; i < events.segments.size();) {
            const std::uint32_t solid = events.segments[i].solid;
            spans_.clear();
            for (; i < events.segments.size() && events.segments[i].solid == solid; ++i)
                if (!(events.segments[i].missed & missed))
                    spans_.emplace_back(events.segments[i].in, events.segments[i].out);
            if (spans_.empty()) continue;
            std::sort(spans_.begin(), spans_.end());
            const auto first = static_cast<std::uint32_t>(toggles.size());
            for (const auto& [in, out] : spans_) {
                if (toggles.size() > first && in <= toggles.back()) {
                    toggles.back() = std::max(toggles.back(), out);
                } else {
                    toggles.push_back(in);
                    toggles.push_back(out);
                }
            }
            entries.push_back({solid, first, static_cast<std::uint32_t>(toggles.size())});
        }
    }
    const Entry* find(std::uint32_t solid) const {
        const auto at = std::lower_bound(entries.begin(), entries.end(), solid,
                                         [](const Entry& e, std::uint32_t s) { return e.solid < s; });
        return at != entries.end() && at->solid == solid ? &*at : nullptr;
    }

private:
    std::vector<std::pair<std::uint32_t, std::uint32_t>> spans_;
};

/// The walk down a tree and back. Lists lie one behind the other on a stack; the topmost is the newest.
class Combiner {
public:
    /// The toggles of a tree, until the next call.
    const std::vector<std::uint32_t>& classify(const std::vector<Node>& tree, const SolidLists& solids) {
        values_.clear();
        frames_.clear();
        lists_.clear();
        std::uint32_t node = 0;
        for (;;) {
            if (++visited_, tree[node].op != Operator::leaf) {
                frames_.push_back({node, 0, tree[node].operands, values_.size(), values_.size(), lists_.size()});
                ++node;
                continue;
            }
            if (const SolidLists::Entry* entry = solids.find(tree[node].operands))
                values_.insert(values_.end(), solids.toggles.begin() + entry->first,
                               solids.toggles.begin() + entry->last);
            ++node;
            // Operands are finished; so may be the operators above.
            for (;;) {
                if (frames_.empty()) return values_;
                Frame& frame = frames_.back();
                const Operator op = tree[frame.node].op;
                if (op == Operator::not_) {
                    complement(frame.first);
                } else if (op == Operator::union_ || op == Operator::xor_) {
                    if (values_.size() > frame.second) lists_.push_back(frame.second);
                    merge_lists(op, frame.lists, frame.done + 1 == frame.operands);
                } else if (frame.done > 0 && (values_.size() > frame.second || op == Operator::intersection)) {
                    merge(op, frame.first, frame.second);
                }
                frame.second = values_.size();
                ++frame.done;
                const bool is_empty =
                    values_.size() == frame.first && (op == Operator::intersection || op == Operator::difference);
                if (frame.done < frame.operands && !is_empty) break;
                node = tree[frame.node].end;
                lists_.resize(frame.lists);
                frames_.pop_back();
            }
        }
    }
    std::uint64_t visited() const { return visited_; }

private:
    struct Frame {
        std::uint32_t node, done, operands;
        std::size_t first;   ///< where the lists of the operands so far begin
        std::size_t second;  ///< ... and that of the next one
        std::size_t lists;   ///< union, xor: the first of its lists among `lists_`
    };

    /// An event before all others toggles the status from the ray's very begin.
    static constexpr std::uint32_t begin = 0xffffffff;
    /// So that `begin` comes first.
    static std::uint32_t key(std::uint32_t event) { return event + 1; }

    void complement(std::size_t first) {
        const auto at = values_.begin() + static_cast<std::ptrdiff_t>(first);
        if (at != values_.end() && *at == begin)
            values_.erase(at);
        else
            values_.insert(at, begin);
    }

    static bool inside(Operator op, bool left, bool right) {
        switch (op) {
            case Operator::union_:
                return left || right;
            case Operator::intersection:
                return left && right;
            case Operator::difference:
                return left && !right;
            default:
                return left != right;
        }
    }

    /// The lists of a union's or a xor's operands so far, from number `from` on: the newest ones while they are no
    /// shorter than half of those before them, or all. So a list of n operands is not merged n times.
    void merge_lists(Operator op, std::size_t from, bool all) {
        while (lists_.size() >= from + 2) {
            const std::size_t first = lists_[lists_.size() - 2], second = lists_.back();
            if (!all && 2 * (values_.size() - second) < second - first) return;
            merge(op, first, second);
            lists_.pop_back();
            if (values_.size() == first) lists_.pop_back();
        }
    }

    /// Roth's combination: merged in order, classified, neighbours joined.
    void merge(Operator op, std::size_t first, std::size_t second) {
        merged_.clear();
        std::size_t a = first, b = second;
        bool left = false, right = false, status = false;
        while (a < second || b < values_.size()) {
            const std::uint32_t next_a = a < second ? key(values_[a]) : 0xffffffff;
            const std::uint32_t next_b = b < values_.size() ? key(values_[b]) : 0xffffffff;
            const std::uint32_t event = std::min(next_a, next_b);
            if (next_a == event) left = !left, ++a;
            if (next_b == event) right = !right, ++b;
            const bool now = inside(op, left, right);
            if (now != status) merged_.push_back(event - 1);
            status = now;
        }
        values_.resize(first);
        values_.insert(values_.end(), merged_.begin(), merged_.end());
    }

    std::vector<std::uint32_t> values_, merged_;
    std::vector<std::size_t> lists_;  ///< where they begin in `values_`, of operands that are not merged yet
    std::vector<Frame> frames_;
    std::uint64_t visited_ = 0;
};

struct Shared : EventScene {
    std::vector<std::vector<Node>> trees = {};  ///< one a region
};

class Worker {
public:
    explicit Worker(const Shared& shared) : shared_(shared) {}
    Counts counts() const { return {{"nodes a ray", {combiner_.visited()}}}; }

    void trace(const Ray& ray, Answer& answer) {
        events_.find(shared_.rays, ray);
        const std::vector<std::uint32_t>& owners =
            owners_.find(events_, [this](std::uint32_t missed, auto& claimed) { classify(missed, claimed); });
        answer.stretches = stretches_of(events_, owners, shared_.first_hits);
    }

private:
    /// Finds the least region that claims each step.
    void classify(std::uint32_t missed, std::vector<std::uint32_t>& claimed) {
        claimed.assign(events_.steps(), NONE);
        solids_.fill(events_, missed);
        regions_.clear();
        for (const SolidLists::Entry& entry : solids_.entries) shared_.add_regions_of(entry.solid, regions_);
        sort_once(regions_);
        for (const std::uint32_t region : regions_) {
            const std::vector<std::uint32_t>& toggles = combiner_.classify(shared_.trees[region], solids_);
            for (std::size_t i = 0; i + 1 < toggles.size(); i += 2)
                for (std::uint32_t step = toggles[i]; step < toggles[i + 1]; ++step)
                    claimed[step] = std::min(claimed[step], region);
        }
    }

    const Shared& shared_;
    RayEvents events_;
    SolidLists solids_;
    Combiner combiner_;
    StepOwners owners_;
    std::vector<std::uint32_t> regions_;
};

}  // namespace

Method roth() {
    return {.name = "Roth",
            .source = "Roth 1982",
            .about =
                "Each node merges its operands' sorted lists of intervals by its truth table. Lists hold numbers "
                "of events, so equal surfaces compare equal. Early outs, no merge with an empty list, regions of "
                "hit solids only, lists on one stack.",
            .breaks =
                "deep_trees: a region's tree is walked whole for each ray that meets one of its solids, and a "
                "chain merges a growing list at each node. No family makes it wrong.",
            .knob = "",
            .prepare = [](const Subject& subject, const TraceOptions& options) {
                Shared shared{{subject, options}};
                for (const FlatTree& tree : subject.compiled.flat_trees)
                    shared.trees.push_back(from_the_root(tree, options.planted));
                return trace_each_ray<Worker>(std::move(shared), options);
            }};
}

}  // namespace csgrt::bench
