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

bool same_first(const Sequence& a, const Sequence& b) {
    return a.empty() || b.empty() ? a.empty() == b.empty() : a.front().region == b.front().region;
}

void Errors::add(double error) {
    ++count_;
    worst_ = std::max(worst_, error);
    if (error == 0) {
        ++zeros_;
    } else if (!std::isfinite(error)) {
        ++infinite_;
    } else {
        int exponent = 0;
        const double fraction = std::frexp(error, &exponent);  // from 1/2 to 1
        ++classes_[64 * exponent + static_cast<int>(128 * (fraction - 0.5))];
    }
}

void Errors::operator+=(const Errors& other) {
    count_ += other.count_;
    zeros_ += other.zeros_;
    infinite_ += other.infinite_;
    worst_ = std::max(worst_, other.worst_);
    for (const auto& [size, count] : other.classes_) classes_[size] += count;
}

double Errors::quantile(double share) const {
    const double rank = std::ceil(share * static_cast<double>(count_));
    double passed = static_cast<double>(zeros_);
    if (passed >= rank) return 0;
    for (const auto& [size, count] : classes_) {
        passed += static_cast<double>(count);
        if (passed < rank) continue;
        const int exponent = (size - ((size % 64) + 64) % 64) / 64, part = size - 64 * exponent;
        return std::min(worst_, std::ldexp(0.5 + (part + 1) / 128.0, exponent));
    }
    return worst_;
}

std::vector<std::int64_t> Errors::counts() const {
    const auto whole = [](std::size_t n) { return static_cast<std::int64_t>(n); };
    std::vector<std::int64_t> all = {whole(count_), whole(zeros_), whole(infinite_)};
    for (const auto& [size, count] : classes_) {
        all.push_back(size);
        all.push_back(whole(count));
    }
    return all;
}

Errors::Errors(const std::vector<std::int64_t>& counts, double worst) : worst_(worst) {
    const auto size = [](std::int64_t n) { return static_cast<std::size_t>(n); };
    count_ = size(counts.at(0));
    zeros_ = size(counts.at(1));
    infinite_ = size(counts.at(2));
    for (std::size_t i = 3; i < counts.size(); i += 2) classes_[static_cast<int>(counts[i])] = size(counts.at(i + 1));
}

void Accuracy::add(const TrueRay& truth, const Sequence& sequence, Mode mode) {
    ++rays;
    const bool first = mode == Mode::first_hits;
    const TrueRay::Verdict verdict = first ? truth.first_verdict : truth.verdict;
    if (verdict == TrueRay::Verdict::tie) ++ties;
    if (verdict == TrueRay::Verdict::rule) ++rule;
    if (verdict != TrueRay::Verdict::decided) return;
    ++decided;
    if (!(first ? same_first(sequence, truth.sequence) : same_regions(sequence, truth.sequence))) {
        ++wrong;
        return;
    }
    bool is_misplaced = false;
    const auto measure = [&](double is, double should, double unit) {
        if (!std::isfinite(should)) return;
        if (unit == 0) {
            ++rule_ends;
            return;
        }
        const double off = std::isfinite(is) ? std::abs(is - should) * truth.speed : HUGE_VAL;
        error_mm.add(off);
        error_ulp.add(off / unit);
        is_misplaced = is_misplaced || off / unit > misplaced_ulps;
    };
    if (first && !sequence.empty() && truth.sequence[0].in > 0)
        measure(sequence[0].in, truth.sequence[0].in, truth.in_unit[0]);
    for (std::size_t i = 0; !first && i < sequence.size(); ++i) {
        if (sequence[i].region == Stretch::gap) continue;  // its ends are its neighbours'
        measure(sequence[i].in, truth.sequence[i].in, truth.in_unit[i]);
        measure(sequence[i].out, truth.sequence[i].out, truth.out_unit[i]);
    }
    misplaced += is_misplaced;
}

void Accuracy::operator+=(const Accuracy& other) {
    rays += other.rays;
    decided += other.decided;
    ties += other.ties;
    rule += other.rule;
    unanswered += other.unanswered;
    wrong += other.wrong;
    misplaced += other.misplaced;
    rule_ends += other.rule_ends;
    error_mm += other.error_mm;
    error_ulp += other.error_ulp;
}

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    const double rank = std::ceil(share * static_cast<double>(values.size()));
    const std::size_t at = static_cast<std::size_t>(std::clamp(rank, 1.0, static_cast<double>(values.size()))) - 1;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
    return values[at];
}

}  // namespace csgrt::bench
