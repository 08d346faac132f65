#include "ray_events.hpp"

#include <limits>
#include <numeric>

namespace csgrt::bench {

void RayEvents::find(const SceneRays& rays, const Ray& ray) {
    rays.boundaries(ray, -std::numeric_limits<double>::infinity(), boundaries_);
    sort(boundaries_, boundaries_.empty() ? 0 : rays.tolerance(ray));
}

void RayEvents::sort(const std::vector<kernel::Boundary>& boundaries, double tolerance) {
    at.clear();
    segments.clear();
    marked = false;
    order_.resize(boundaries.size());
    event_of_.resize(boundaries.size());
    std::iota(order_.begin(), order_.end(), 0u);
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return boundaries[a].t < boundaries[b].t || (boundaries[a].t == boundaries[b].t && a < b);
    });
    double first = 0;
    for (const std::uint32_t end : order_) {
        const double t = boundaries[end].t;
        if (at.empty() || !(t == first || t - first <= tolerance)) at.push_back(first = t);
        event_of_[end] = static_cast<std::uint32_t>(at.size() - 1);
    }
    for (std::size_t i = 0; i < boundaries.size(); i += 2) {
        if (event_of_[i] >= event_of_[i + 1]) continue;
        const std::uint32_t missed = boundaries[i].surface & MISSED;
        segments.push_back({boundaries[i].solid, event_of_[i], event_of_[i + 1], missed});
        marked = marked || missed;
    }
}

void append(Sequence& stretches, const Stretch& next) {
    if (!stretches.empty() && stretches.back().region == next.region && stretches.back().out == next.in)
        stretches.back().out = next.out;
    else
        stretches.push_back(next);
}

Sequence stretches_of(const RayEvents& events, const std::vector<std::uint32_t>& region_of_step, bool first) {
    Sequence stretches;
    for (std::uint32_t step = 0; step < events.steps(); ++step)
        if (region_of_step[step] != NONE)
            append(stretches, {region_of_step[step], events.at[step], events.at[step + 1]});
    if (!first) return stretches;
    const auto hit = std::find_if(stretches.begin(), stretches.end(), [](const Stretch& s) { return s.out > 0; });
    return hit == stretches.end() ? Sequence{} : Sequence{*hit};
}

const std::vector<std::uint32_t>& StepOwners::find(const RayEvents& events, const Classify& classify) {
    classify(0, owners_);
    if (!events.marked) return owners_;
    // Steps that no marked segment covers are the same on all sides.
    const auto for_touched = [&](const auto& change) {
        for (const RayEvents::Segment& segment : events.segments)
            for (std::uint32_t step = segment.in; segment.missed && step < segment.out; ++step) change(step);
    };
    // Where two solids are, and so two sides.
    first_.assign(events.steps(), NONE);
    moved_.assign(events.steps(), 0);
    for (const RayEvents::Segment& segment : events.segments)
        for (std::uint32_t step = segment.in; step < segment.out; ++step) {
            moved_[step] = moved_[step] || (first_[step] != NONE && first_[step] != segment.solid);
            first_[step] = segment.solid;
        }
    for_touched([&](std::uint32_t step) { owners_[step] = moved_[step] ? NONE : owners_[step]; });
    for (std::uint32_t side = 1; side < SIDES; ++side) {
        classify(kernel::missed_on(side), here_);
        for_touched([&](std::uint32_t step) {
            if (moved_[step]) owners_[step] = std::min(owners_[step], here_[step]);
        });
    }
    return owners_;
}

std::vector<std::vector<std::uint32_t>> regions_of_solids(const CompiledScene& scene) {
    std::vector<std::vector<std::uint32_t>> lists(scene.solids.size());
    for (std::uint32_t region = 0; region < scene.flat_trees.size(); ++region)
        for (const FlatTree::Node& node : scene.flat_trees[region].nodes) {
            if (node.op != Operator::leaf) continue;
            std::vector<std::uint32_t>& list = lists[node.solid];
            if (list.empty() || list.back() != region) list.push_back(region);
        }
    return lists;
}

}  // namespace csgrt::bench
