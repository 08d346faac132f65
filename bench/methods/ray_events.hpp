// A ray's ends as events: what methods on the host sort before they look at regions.
//
// Ends within the tolerance of the first of them are one event, as everywhere in csgrt; afterwards a method compares
// whole numbers, and no rounding can tell two equal surfaces apart.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "method.hpp"
#include "scene_rays.hpp"

namespace csgrt::bench {

struct RayEvents {
    /// A segment that is not shorter than the tolerance: it covers the steps from `in` to before `out`.
    struct Segment {
        std::uint32_t solid, in, out;
        std::uint32_t missed;  ///< MISSED_... of its ends
    };
    std::vector<double> at;         ///< of each event its distance; step k lies between events k and k + 1
    std::vector<Segment> segments;  ///< by ascending solid
    bool marked = false;            ///< the ray runs in a face: some segment has MISSED_... set

    /// Replaces all by what the ray meets.
    void find(const SceneRays& rays, const Ray& ray);
    /// The same of boundaries in memory, in then out by ascending solid.
    void sort(const std::vector<kernel::Boundary>& boundaries, double tolerance);
    std::uint32_t steps() const { return at.empty() ? 0 : static_cast<std::uint32_t>(at.size() - 1); }

private:
    std::vector<kernel::Boundary> boundaries_;
    std::vector<std::uint32_t> order_, event_of_;
};

/// Appends a stretch, or lengthens the last one if it is of the same region and touches it.
void append(Sequence& stretches, const Stretch& next);
/// Of each step the region that claims it, or NONE -> the ray's stretches. `first`: only the first one that does not
/// end at or behind the ray's start.
Sequence stretches_of(const RayEvents& events, const std::vector<std::uint32_t>& region_of_step, bool first);

/// Of each step the region that claims it, on any side of the faces that the ray runs in.
class StepOwners {
public:
    /// `classify` finds of each step the least region that claims it, or NONE, by the segments that have none of
    /// `missed`.
    using Classify = std::function<void(std::uint32_t missed, std::vector<std::uint32_t>& claimed)>;
    const std::vector<std::uint32_t>& find(const RayEvents& events, const Classify& classify);

private:
    std::vector<std::uint32_t> owners_, here_, first_;
    std::vector<std::uint8_t> moved_;
};

/// The regions whose trees have a solid: a list for each solid, ascending.
std::vector<std::vector<std::uint32_t>> regions_of_solids(const CompiledScene& scene);

/// What the threads share of methods that look at events; each method adds its own.
struct EventScene {
    EventScene(const Subject& subject, const TraceOptions& options)
        : rays(subject.compiled), first_hits(options.first_hits), regions_of(regions_of_solids(subject.compiled)) {}

    void add_regions_of(std::uint32_t solid, std::vector<std::uint32_t>& regions) const {
        regions.insert(regions.end(), regions_of[solid].begin(), regions_of[solid].end());
    }

    SceneRays rays;
    bool first_hits;
    std::vector<std::vector<std::uint32_t>> regions_of;  ///< of each solid
};

/// Ascending, each number once.
inline void sort_once(std::vector<std::uint32_t>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace csgrt::bench
