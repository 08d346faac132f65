#include "analysis/estimates.hpp"

#include <algorithm>
#include <limits>

#include "analysis/boxes.hpp"

namespace csgrt::analysis {

namespace {

/// The 97.5 % quantile of Student's t for 16 or 32 batches.
double quantile(std::size_t batches) { return batches == most_batches ? 2.0395134464 : 2.1314495456; }

/// The mean of a figure over the batches, and its interval. `figure_of(batch)`: the figure of a batch, or how much it
/// adds to the mean's error.
template <class Batches, class FigureOf>
Estimate mean_of(const Batches& batches, const FigureOf& figure_of) {
    const auto count = static_cast<double>(batches.size());
    double sum = 0, squares = 0;
    for (const auto& batch : batches) sum += figure_of(batch);
    const double mean = sum / count;
    for (const auto& batch : batches) squares += (figure_of(batch) - mean) * (figure_of(batch) - mean);
    return {mean, quantile(batches.size()) * std::sqrt(squares / (count - 1) / count)};
}

/// The moments of inertia from the second moments: xx is the integral of yy + zz; products stay.
template <class Totals, class SumsOf>
std::array<Estimate, 6> inertia_of(const std::vector<Totals>& batches, const SumsOf& sums_of) {
    std::array<Estimate, 6> all;
    for (std::size_t i = 0; i < 6; ++i) {
        all[i] = mean_of(batches, [&](const Totals& batch) {
            const auto& s = sums_of(batch).second;
            return i < 3 ? s[(i + 1) % 3] + s[(i + 2) % 3] : s[i];
        });
    }
    return all;
}

struct Totals {
    Sums plain = {}, weighted = {};
};

}  // namespace

Estimate estimate_of(const std::array<double, least_batches>& batches) {
    return mean_of(batches, [](double figure) { return figure; });
}

VolumeSoFar volume_of(const Source& source) {
    VolumeSoFar so_far;
    if (source.batches.empty()) return so_far;
    const double by = static_cast<double>(source.batches.size()) / source.replicates;
    const std::vector<Sums> batches(source.batches.begin(), source.batches.end());
    so_far.volume = mean_of(batches, [by](const Sums& s) { return by * s.volume; });
    for (const Sums& s : batches) so_far.rows += s.rows;
    return so_far;
}

void estimate(std::span<const Source> regions, bool is_mass, Measured& measured) {
    std::size_t count = most_batches;
    for (const Source& region : regions) count = std::min(count, region.batches.size());
    if (regions.empty() || count == 0) return;
    const Vec3 middle = regions.size() == 1 ? regions[0].middle : center_of(measured.box);
    std::vector<Totals> batches(count);
    for (const Source& region : regions) {
        const double by = static_cast<double>(count) / region.replicates;
        std::vector<Sums> own(count);
        for (std::size_t i = 0; i < region.batches.size(); ++i) own[i % count].add(region.batches[i], by, by);
        for (std::size_t i = 0; i < count; ++i) {
            batches[i].plain.add(own[i], 1, 1);
            batches[i].weighted.add(own[i].from(middle - region.middle), region.weight, 0);
        }
    }
    measured.volume = mean_of(batches, [](const Totals& t) { return t.plain.volume; });
    measured.claimed = mean_of(batches, [](const Totals& t) { return t.plain.volume + t.plain.others; });
    measured.area = mean_of(batches, [](const Totals& t) { return t.plain.area; });
    const Estimate weight = mean_of(batches, [](const Totals& t) { return t.weighted.volume; });
    if (is_mass) measured.mass = weight;

    // The centroid is a ratio of two means. To first order, its error is the mean of what each batch has about it.
    Sums total;
    for (const Totals& t : batches) total.add(t.weighted, 1, 1);
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    const Vec3 off = total.volume > 0 ? 1 / total.volume * total.first : Vec3{unknown, unknown, unknown};
    const Vec3 centroid = middle + off;
    for (std::size_t i = 0; i < 3; ++i) {
        const double Vec3::*axis = axes[i];
        const Estimate error = mean_of(batches, [&](const Totals& t) {
            return (t.weighted.first.*axis - off.*axis * t.weighted.volume) / weight.value;
        });
        measured.centroid[i] = {centroid.*axis, error.half_width};
    }
    measured.origin = inertia_of(batches, [&](const Totals& t) { return t.weighted.from(-1.0 * middle); });
    measured.central = inertia_of(batches, [&](const Totals& t) { return t.weighted.from(off); });
}

}  // namespace csgrt::analysis
