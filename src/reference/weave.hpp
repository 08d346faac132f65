// Weave: the simple method for the reference. It sorts all boundaries, takes the boundaries within the tolerance of the
// first as one event, and keeps a list of the covering segments.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>
#include <vector>

#include "kernel_host/kernels.hpp"

namespace csgrt {

/// A partition of a ray before evaluation: its boundaries, and the segments that cover it.
struct WovenPartition {
    double in = 0, out = 0;
    std::uint32_t in_boundary = 0, out_boundary = 0;  ///< indices of boundaries: 2 x segment + side
    std::vector<std::uint32_t> segments;              ///< covering segments, ascending, each once
};

/// Memory that is used for one ray after another: new memory took a sixth of the time of a ray through a few solids.
struct Weaver {
    std::vector<std::uint32_t> order, covering, begun, ended, stay, enter, next;
    std::vector<WovenPartition> partitions;  ///< the partitions of the last ray, then unused partitions of earlier rays

    WovenPartition& append(std::size_t count) {
        if (count == partitions.size()) partitions.emplace_back();
        return partitions[count];
    }
};

/// Makes partitions. `boundaries`: two boundaries a segment, in then out; their t and the tolerance are in the
/// precision of the geometry that found them. The partitions are valid until `weaver` is used again.
template <class Boundary>
std::span<const WovenPartition> weave(const std::vector<Boundary>& boundaries, decltype(Boundary::t) tolerance,
                                      Weaver& weaver) {
    std::vector<std::uint32_t>&order = weaver.order, &covering = weaver.covering, &begun = weaver.begun,
    &ended = weaver.ended, &stay = weaver.stay, &enter = weaver.enter, &next = weaver.next;
    std::vector<WovenPartition>& partitions = weaver.partitions;
    order.resize(boundaries.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return boundaries[a].t < boundaries[b].t || (boundaries[a].t == boundaries[b].t && a < b);
    });

    std::size_t count = 0;
    covering.clear();
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        const auto t = boundaries[order[begin]].t;
        const auto at = static_cast<double>(t);
        while (end < order.size() && (boundaries[order[end]].t == t || boundaries[order[end]].t - t <= tolerance))
            ++end;

        // The segments that cover the next partition: the segments of the last partition without those that end here,
        // and the segments that begin here and do not end here.
        for (auto* list : {&begun, &ended, &stay, &enter, &next}) list->clear();
        for (std::size_t i = begin; i < end; ++i) (order[i] % 2 ? ended : begun).push_back(order[i] / 2);
        std::sort(begun.begin(), begun.end());
        std::sort(ended.begin(), ended.end());
        std::set_difference(covering.begin(), covering.end(), ended.begin(), ended.end(), std::back_inserter(stay));
        std::set_difference(begun.begin(), begun.end(), ended.begin(), ended.end(), std::back_inserter(enter));
        std::merge(stay.begin(), stay.end(), enter.begin(), enter.end(), std::back_inserter(next));

        const auto contains = [](const std::vector<std::uint32_t>& list, std::uint32_t value) {
            return std::binary_search(list.begin(), list.end(), value);
        };
        const auto first_of = [&](std::uint32_t side, const std::vector<std::uint32_t>& list) {
            const auto found = std::find_if(order.begin() + static_cast<std::ptrdiff_t>(begin),
                                            order.begin() + static_cast<std::ptrdiff_t>(end),
                                            [&](std::uint32_t e) { return e % 2 == side && contains(list, e / 2); });
            return found == order.begin() + static_cast<std::ptrdiff_t>(end) ? NONE : *found;
        };
        const std::uint32_t in_boundary = first_of(0, enter), out_boundary = first_of(1, covering);
        if (in_boundary == NONE && out_boundary == NONE) continue;  // only segments shorter than the tolerance
        if (!covering.empty()) {
            partitions[count - 1].out = at;
            partitions[count - 1].out_boundary = out_boundary != NONE ? out_boundary : in_boundary;
        }
        if (!next.empty()) {
            WovenPartition& partition = weaver.append(count++);
            partition.in = partition.out = at;
            partition.in_boundary = in_boundary != NONE ? in_boundary : out_boundary;
            partition.out_boundary = 0;
            partition.segments = next;
        }
        covering.swap(next);
    }
    return {partitions.data(), count};
}

}  // namespace csgrt
