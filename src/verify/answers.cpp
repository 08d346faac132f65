#include "verify/answers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace csgrt {
namespace {

bool same_regions(const std::vector<Partition>& a, const std::vector<Partition>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Partition& p, const Partition& q) { return p.region == q.region; });
}

constexpr std::uint32_t no_region = 0xffffffff;

std::uint32_t region_at(const std::vector<Partition>& partitions, double t) {
    for (const Partition& p : partitions)
        if (p.in <= t && t <= p.out) return p.region;
    return no_region;
}

}  // namespace

double length(Vec3 v) { return std::hypot(v.x, v.y, v.z); }

double cosine(Vec3 direction, Vec3 normal) {
    const double product = direction.x * normal.x + direction.y * normal.y + direction.z * normal.z;
    return std::abs(product) / length(direction);
}

double Blur::of(Vec3 normal) const { return std::min(shift / cosine(direction, normal), 2 * std::sqrt(size * shift)); }

bool Blur::ends_at_start(const Partition& partition) const {
    return std::abs(partition.out) * length(direction) <= tolerance + of(partition.out_normal);
}

std::vector<Partition> that_count(const std::vector<Partition>& partitions, const Blur& blur) {
    const double speed = length(blur.direction);
    std::vector<Partition> kept;
    for (const Partition& p : partitions) {
        if ((p.out - p.in) * speed <= blur.tolerance + blur.of(p.in_normal) + blur.of(p.out_normal)) continue;
        if (!kept.empty() && kept.back().region == p.region) {
            Partition& last = kept.back();
            const double gap = (p.in - last.out) * speed;
            if (gap <= blur.tolerance + blur.of(last.out_normal) + blur.of(p.in_normal)) {
                last.out = p.out;
                last.out_normal = p.out_normal;
                last.out_solid = p.out_solid;
                continue;
            }
        }
        kept.push_back(p);
    }
    std::erase_if(kept, [&](const Partition& p) { return blur.ends_at_start(p); });
    return kept;
}

Pairing pair(const std::vector<Partition>& a, const std::vector<Partition>& b, const Blur& blur) {
    const auto at_start = [&](const Partition& p) { return blur.ends_at_start(p); };
    if (same_regions(a, b) && std::none_of(a.begin(), a.end(), at_start) && std::none_of(b.begin(), b.end(), at_start))
        return {true, true};
    return {same_regions(that_count(a, blur), that_count(b, blur)), false};
}

RegionDifference difference_of(const std::vector<Partition>& exact, const std::vector<Partition>& found,
                               const Blur& blur) {
    const std::vector<Partition> a = that_count(exact, blur), b = that_count(found, blur);
    const std::size_t shorter = std::min(a.size(), b.size());
    std::size_t before = 0, behind = 0;
    while (before < shorter && a[before].region == b[before].region) ++before;
    while (behind < shorter - before && a[a.size() - 1 - behind].region == b[b.size() - 1 - behind].region) ++behind;
    RegionDifference difference;
    for (std::size_t i = before; i < a.size() - behind; ++i) difference.exact.push_back(a[i].region);
    for (std::size_t i = before; i < b.size() - behind; ++i) difference.found.push_back(b[i].region);
    return difference;
}

bool stands_alone(const std::vector<Partition>& found, std::span<const RayPartitions> neighbours, const Blur& blur) {
    std::vector<double> boundaries;
    double first_that_counts = -std::numeric_limits<double>::infinity();
    const auto add_boundaries = [&](const std::vector<Partition>& partitions) {
        for (const Partition& p : partitions) {
            boundaries.push_back(p.in);
            boundaries.push_back(p.out);
            if (blur.ends_at_start(p)) first_that_counts = 0;
        }
    };
    add_boundaries(found);
    for (const RayPartitions& neighbour : neighbours) add_boundaries(neighbour.partitions);
    std::sort(boundaries.begin(), boundaries.end());
    const double least = (blur.tolerance + 4 * std::sqrt(blur.size * blur.shift)) / length(blur.direction);
    for (std::size_t i = 0; i + 1 < boundaries.size(); ++i) {
        if (!(boundaries[i + 1] - boundaries[i] > least) || std::isinf(boundaries[i + 1] - boundaries[i])) continue;
        const double middle = boundaries[i] + 0.5 * (boundaries[i + 1] - boundaries[i]);
        if (middle < first_that_counts) continue;
        const std::uint32_t first = region_at(neighbours.front().partitions, middle);
        if (region_at(found, middle) != first &&
            std::all_of(neighbours.begin(), neighbours.end(),
                        [&](const RayPartitions& n) { return region_at(n.partitions, middle) == first; }))
            return true;
    }
    return false;
}

}  // namespace csgrt
