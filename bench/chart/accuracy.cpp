#include "accuracy.hpp"

#include <algorithm>
#include <cmath>

namespace csgrt::bench {

Sequence sequence_of(const RayPartitions& found) {
    Sequence sequence;
    for (const Partition& p : found.partitions) {
        if (!(p.out > 0)) continue;
        if (!sequence.empty() && sequence.back().out != p.in)
            sequence.push_back({Stretch::gap, sequence.back().out, p.in});
        sequence.push_back({p.region, p.in, p.out});
    }
    return sequence;
}

Sequence joined(const Sequence& stretches) {
    Sequence sequence;
    for (const Stretch& s : stretches) {
        if (!(s.out > 0)) continue;
        if (!sequence.empty() && sequence.back().out == s.in && sequence.back().region == s.region) {
            sequence.back().out = s.out;
            continue;
        }
        if (!sequence.empty() && sequence.back().out != s.in)
            sequence.push_back({Stretch::gap, sequence.back().out, s.in});
        sequence.push_back(s);
    }
    return sequence;
}

bool same_regions(const Sequence& a, const Sequence& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Stretch& x, const Stretch& y) { return x.region == y.region; });
}

void Accuracy::add(const TrueRay& truth, const Sequence& sequence) {
    ++rays;
    if (truth.verdict == TrueRay::Verdict::tie) ++ties;
    if (truth.verdict == TrueRay::Verdict::rule) ++rule;
    if (truth.verdict != TrueRay::Verdict::decided) return;
    ++decided;
    if (!same_regions(sequence, truth.sequence)) {
        ++wrong;
        return;
    }
    const auto measure = [&](double is, double should, double unit) {
        if (!std::isfinite(should)) return;
        if (unit == 0) {
            ++rule_ends;
            return;
        }
        const double off = std::isfinite(is) ? std::abs(is - should) * truth.speed : HUGE_VAL;
        error_mm.push_back(off);
        error_ulp.push_back(off / unit);
    };
    for (std::size_t i = 0; i < sequence.size(); ++i) {
        if (sequence[i].region == Stretch::gap) continue;  // its ends are its neighbours'
        measure(sequence[i].in, truth.sequence[i].in, truth.in_unit[i]);
        measure(sequence[i].out, truth.sequence[i].out, truth.out_unit[i]);
    }
}

void Accuracy::operator+=(const Accuracy& other) {
    rays += other.rays;
    decided += other.decided;
    ties += other.ties;
    rule += other.rule;
    wrong += other.wrong;
    rule_ends += other.rule_ends;
    error_mm.insert(error_mm.end(), other.error_mm.begin(), other.error_mm.end());
    error_ulp.insert(error_ulp.end(), other.error_ulp.begin(), other.error_ulp.end());
}

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    const double rank = std::ceil(share * static_cast<double>(values.size()));
    const std::size_t at = static_cast<std::size_t>(std::clamp(rank, 1.0, static_cast<double>(values.size()))) - 1;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
    return values[at];
}

}  // namespace csgrt::bench
