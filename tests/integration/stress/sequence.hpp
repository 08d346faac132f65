// A ray's regions as a sequence, gaps included, and how it compares with what it must be.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <csgrt/renderer.hpp>

#include "integration/stress/truth.hpp"

namespace csgrt::test {

inline constexpr std::uint32_t nothing = 0xffffffff;  ///< in place of a region: a gap between two

struct Item {
    std::uint32_t region = 0;
    double in = 0, out = 0;
    double in_tolerance = 0, out_tolerance = 0;
};
using Sequence = std::vector<Item>;

inline bool same_regions(const Sequence& a, const Sequence& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Item& x, const Item& y) { return x.region == y.region; });
}

/// Appends a stretch; what abuts and is of the same region is joined.
inline void append(Sequence& sequence, const Item& item) {
    if (!sequence.empty() && sequence.back().out == item.in && sequence.back().region == item.region) {
        sequence.back().out = item.out;
        sequence.back().out_tolerance = item.out_tolerance;
        return;
    }
    if (!sequence.empty() && sequence.back().out != item.in) {
        const Item last = sequence.back();
        sequence.push_back({nothing, last.out, item.in, last.out_tolerance, item.in_tolerance});
    }
    sequence.push_back(item);
}

/// As `shoot` reported it.
inline Sequence sequence_of(const RayPartitions& found) {
    Sequence sequence;
    for (const Partition& p : found.partitions) append(sequence, {p.region, p.in, p.out, 0, 0});
    return sequence;
}

/// What `shoot` must report, from the ray's start on. Sets `tie` if something ends at the start itself.
inline Sequence sequence_of(const Truth& truth, bool& tie) {
    Sequence sequence;
    for (const TrueStretch& s : truth.stretches) {
        if (std::abs(s.in) <= s.in_tolerance || std::abs(s.out) <= s.out_tolerance) tie = true;
        append(sequence, {s.claims.front(), s.in, s.out, s.in_tolerance, s.out_tolerance});
    }
    const auto ahead =
        std::find_if(sequence.begin(), sequence.end(), [](const Item& i) { return i.out > 0 && i.region != nothing; });
    sequence.erase(sequence.begin(), ahead);
    return sequence;
}

/// From how the scene was made; ends may be off by some units in the last place of the ray's numbers.
inline Sequence sequence_of(const std::vector<stress::Stretch>& known, const Ray& ray) {
    const double from = std::abs(ray.origin.x) + std::abs(ray.origin.y) + std::abs(ray.origin.z);
    const double speed = std::abs(ray.direction.x) + std::abs(ray.direction.y) + std::abs(ray.direction.z);
    Sequence sequence;
    for (const stress::Stretch& s : known) {
        if (s.out <= 0) continue;
        const auto tolerance = [&](double t) { return 1e-13 * (std::abs(t) + from / speed); };
        append(sequence, {s.region, s.in, s.out, tolerance(s.in), tolerance(s.out)});
    }
    return sequence;
}

/// The sets of regions that overlap, in order.
inline std::vector<std::vector<std::uint32_t>> overlaps_of(const RayPartitions& found) {
    std::vector<std::vector<std::uint32_t>> sets;
    double last = 0;
    for (const Overlap& o : found.overlaps) {
        if (sets.empty() || sets.back() != o.regions || last != o.in) sets.push_back(o.regions);
        last = o.out;
    }
    return sets;
}
inline std::vector<std::vector<std::uint32_t>> overlaps_of(const Truth& truth) {
    std::vector<std::vector<std::uint32_t>> sets;
    for (const TrueStretch& s : truth.stretches)
        if (s.out > 0 && s.claims.size() > 1) sets.push_back(s.claims);
    return sets;
}

/// By how much an end is off, in units of what it may be off; the worst of two sequences of the same regions.
/// `slack`: along the ray, added to what is allowed. An end that is off by more than `allowed` units counts as far.
inline double worst_end(const Sequence& found, const Sequence& expected, double slack) {
    double worst = 0;
    const auto look = [&](double a, double b, double tolerance) {
        if (a != b) worst = std::max(worst, std::abs(a - b) / (tolerance + slack));
    };
    for (std::size_t i = 0; i < found.size(); ++i) {
        look(found[i].in, expected[i].in, expected[i].in_tolerance);
        look(found[i].out, expected[i].out, expected[i].out_tolerance);
    }
    return worst;
}

}  // namespace csgrt::test
