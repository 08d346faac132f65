// Mostajabodaveh et al. 2017: "CSG ray tracing revisited"; thesis section 2.1.1, equation 2.6.
//
// Theory: a model is a union of layers, and each layer is a union of positive solids less a union of negative ones.
// Along a ray two counters are kept a layer: how many positive solids the ray is in, and how many negative ones. It is
// in the layer where the first is not 0 and the second is 0. No tree is walked.
//
//     (a - b) + (c - b - d)    layers a | b and c | b, d
//     (a + c) - b              one layer a, c | b
//
// Layers cannot hold an intersection of two solids, a difference whose right side is itself a difference
// (A - (B - C) = (A - B) + (A and C)), or xor. A region fits if its tree in positive form is a union of terms, each an
// intersection of at most one positive part, which fits, with complements of solids. Here a region that does not fit is
// refused: a ray that crosses one of its solids is given up, and counted.
//
// A layer that would need the numbers of 4 million solids is refused, too.
//
// Cost: an addition for each end and each layer of its solid; layers with equal negative solids are one.
// Prediction: nine tenths of the regions of hand-made models fit, but of the rays over such models a third is given up,
// since the others are large; on what it answers it is right, and as fast as Jansen's status tree. Broken by nested and
// deep_trees: nothing fits.
#include <map>
#include <optional>

#include "device_method.hpp"
#include "each_ray.hpp"
#include "list.hpp"
#include "ray_events.hpp"

namespace csgrt::bench {
namespace {

using Solids = std::vector<std::uint32_t>;

/// Of a node of a positive tree: a union of layers, by their negative solids; or the complement of a union of solids,
/// which is one entry without positive solids.
using Layers = std::map<Solids, Solids>;

bool is_complement(const Layers& part) { return part.size() == 1 && part.begin()->second.empty(); }

/// Layers of a tree, bottom up.
class LayerMaker {
public:
    /// Nothing: layers cannot hold it, or only by more than `most` numbers.
    std::optional<Layers> layers_of(const PositiveTree& tree) {
        std::vector<Layers> parts(tree.nodes.size());
        for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
            const PositiveTree::Node& node = tree.nodes[i];
            if (node.gate == Gate::leaf) {
                const Solids solid{node.left};
                parts[i] = node.complement ? Layers{{solid, {}}} : Layers{{{}, solid}};
                continue;
            }
            Layers &left = parts[node.left], &right = parts[node.right];
            if (is_complement(left)) left.swap(right);
            if (node.gate == Gate::intersection && is_complement(right))
                parts[i] = without(left, right.begin()->first);
            else if (node.gate == Gate::union_ && !is_complement(right) && !is_complement(left))
                parts[i] = united(left, right);
            else
                return {};
            left = right = {};
            if (written_ > most) return {};
        }
        if (parts.empty()) return Layers{};
        return is_complement(parts.back()) ? std::nullopt : std::optional(std::move(parts.back()));
    }

private:
    static constexpr std::size_t most = 4'000'000;

    Solids both(const Solids& a, const Solids& b) {
        Solids all;
        std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
        written_ += all.size();
        return all;
    }
    Layers united(Layers& a, Layers& b) {
        if (a.size() < b.size()) a.swap(b);
        for (const auto& [negative, positive] : b) {
            Solids& solids = a[negative];
            solids = both(solids, positive);
        }
        return std::move(a);
    }
    Layers without(const Layers& part, const Solids& subtracted) {
        Layers all;
        for (const auto& [negative, positive] : part) {
            Solids& solids = all[both(negative, subtracted)];
            solids = both(solids, positive);
        }
        return all;
    }

    std::size_t written_ = 0;
};

struct Shared : EventScene {
    /// What a solid is to a layer.
    struct Role {
        std::uint32_t layer;
        bool negative;
    };
    std::vector<std::vector<Role>> roles = {};  ///< of each solid
    std::vector<std::uint32_t> region_of = {};  ///< of each layer
    std::vector<std::uint8_t> is_refused = {};  ///< by solid: some region that has it does not fit
    std::uint64_t regions = 0, fitting = 0;
};

class Worker {
public:
    explicit Worker(const Shared& shared) : shared_(shared), states_(shared.region_of.size()) {}

    void trace(const Ray& ray, Answer& answer) {
        events_.find(shared_.rays, ray);
        answer.answered = std::none_of(events_.segments.begin(), events_.segments.end(),
                                       [&](const auto& segment) { return shared_.is_refused[segment.solid]; });
        met_ += !events_.segments.empty();
        refused_ += !answer.answered;
        if (!answer.answered) return;
        const auto& claimed =
            owners_.find(events_, [this](std::uint32_t missed, auto& steps) { classify(missed, steps); });
        answer.stretches = stretches_of(events_, claimed, shared_.first_hits);
    }
    Counts counts() const {
        return {{"regions that fit, share", {shared_.fitting, std::max<std::uint64_t>(shared_.regions, 1)}},
                {"layers a fitting region", {shared_.region_of.size(), std::max<std::uint64_t>(shared_.fitting, 1)}},
                {"rays refused, share of those that meet a solid", {refused_, std::max<std::uint64_t>(met_, 1)}}};
    }

private:
    struct State {
        int positive = 0, negative = 0;
        std::uint32_t since = NONE;  ///< the step at which the ray has entered the layer
    };
    struct Crossing {
        std::uint32_t event, solid;
        int change;
    };

    /// Of each step the least region that claims it.
    void classify(std::uint32_t missed, std::vector<std::uint32_t>& claimed) {
        claimed.assign(events_.steps(), NONE);
        crossings_.clear();
        for (const RayEvents::Segment& segment : events_.segments) {
            if (segment.missed & missed) continue;
            crossings_.push_back({segment.in, segment.solid, 1});
            crossings_.push_back({segment.out, segment.solid, -1});
        }
        std::sort(crossings_.begin(), crossings_.end(), [](const auto& a, const auto& b) { return a.event < b.event; });
        for (std::size_t i = 0, next = 0; i < crossings_.size(); i = next) {
            const std::uint32_t event = crossings_[i].event;
            touched_.clear();
            for (; next < crossings_.size() && crossings_[next].event == event; ++next)
                for (const Shared::Role& role : shared_.roles[crossings_[next].solid]) {
                    State& state = states_[role.layer];
                    (role.negative ? state.negative : state.positive) += crossings_[next].change;
                    touched_.push_back(role.layer);
                }
            for (const std::uint32_t layer : touched_) {
                State& state = states_[layer];
                const bool inside = state.positive > 0 && state.negative == 0;
                if (inside == (state.since != NONE)) continue;
                for (std::uint32_t step = state.since; !inside && step < event; ++step)
                    claimed[step] = std::min(claimed[step], shared_.region_of[layer]);
                state.since = inside ? event : NONE;
            }
        }
        // All segments have ended, and the states are as at first.
    }

    const Shared& shared_;
    RayEvents events_;
    StepOwners owners_;
    std::vector<State> states_;  ///< by layer
    std::vector<Crossing> crossings_;
    std::vector<std::uint32_t> touched_;
    std::uint64_t met_ = 0, refused_ = 0;
};

}  // namespace

Method layers() {
    return {
        .name = "layers",
        .source = "Mostajabodaveh et al. 2017",
        .about =
            "Regions are unions of layers, positive solids less negative ones, and two counters a layer are kept "
            "along the ray. Regions that layers cannot hold (intersections, differences within a subtracted part, "
            "xor) are refused, and so are the rays that cross their solids.",
        .breaks = "nested and deep_trees: nothing fits. No family makes it wrong.",
        .knob = "",
        .gives_up = true,
        .prepare = [](const Subject& subject, const TraceOptions& options) {
            Shared shared{{subject, options}};
            shared.roles.resize(subject.compiled.solids.size());
            shared.is_refused.resize(subject.compiled.solids.size());
            std::uint32_t region = 0;
            for (const PositiveTree& tree : positive_trees(subject.compiled, Grouping::least_height, options.planted)) {
                const std::optional<Layers> made = LayerMaker().layers_of(tree);
                shared.fitting += made.has_value();
                for (const auto& [negative, positive] : made.value_or(Layers{})) {
                    const auto layer = static_cast<std::uint32_t>(shared.region_of.size());
                    shared.region_of.push_back(region);
                    for (const std::uint32_t solid : positive) shared.roles[solid].push_back({layer, false});
                    for (const std::uint32_t solid : negative) shared.roles[solid].push_back({layer, true});
                }
                for (const PositiveTree::Node& node : tree.nodes)
                    if (!made && node.gate == Gate::leaf) shared.is_refused[node.left] = true;
                ++region;
            }
            shared.regions = region;
            return trace_each_ray<Worker>(std::move(shared), options);
        }};
}

}  // namespace csgrt::bench
