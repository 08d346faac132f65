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
    std::uint32_t steps() const { return at.empty() ? 0 : static_cast<std::uint32_t>(at.size() - 1); }

private:
    std::vector<kernel::Boundary> boundaries_;
    std::vector<std::uint32_t> order_, event_of_;
};

/// Appends a stretch, or lengthens the last one if it is of the same region and touches it.
void append(Sequence& stretches, const Stretch& next);
/// Of each step the region that claims it, or NONE -> the ray's stretches.
Sequence stretches_of(const RayEvents& events, const std::vector<std::uint32_t>& region_of_step);
/// Leaves only the first stretch that does not end at or behind the ray's start.
void keep_first_hit(Sequence& stretches);

/// The regions whose trees have a solid: a list for each solid, ascending.
std::vector<std::vector<std::uint32_t>> regions_of_solids(const CompiledScene& scene);

/// Calls work(first, last) for pieces of the rays, several at once, on the threads that the options ask for; then
/// leaves of the answers what the options want. Returns the seconds that the work took.
double trace_in_pieces(const TraceOptions& options, std::size_t piece, std::vector<Answer>& answers,
                       const std::function<void(std::size_t first, std::size_t last)>& work);

}  // namespace csgrt::bench
