// A ray's answer held against the truth: the regions it meets, and where.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include <csgrt/renderer.hpp>

namespace csgrt::bench {

/// One stretch of a ray from its first region on: a region, or the gap between two.
struct Stretch {
    static constexpr std::uint32_t gap = 0xffffffff;
    std::uint32_t region = gap;
    double in = 0, out = 0;  ///< along the ray, in units of its direction
    bool operator==(const Stretch&) const = default;
};
using Sequence = std::vector<Stretch>;

/// Without the part behind the ray's start.
Sequence sequence_of(const RayPartitions& found);
/// The same of stretches without gaps, some of which may touch or lie behind the ray's start.
Sequence joined(const Sequence& stretches);
/// The same regions and gaps in the same order, wherever they begin.
bool same_regions(const Sequence& a, const Sequence& b);

/// The same first region, or none in both.
bool same_first(const Sequence& a, const Sequence& b);

/// What is asked of a ray.
enum class Mode : std::uint8_t { first_hits, every_partition };
inline const char* name_of(Mode mode) { return mode == Mode::first_hits ? "first hits" : "every partition"; }

/// What a ray must meet.
struct TrueRay {
    enum class Verdict : std::uint8_t {
        decided,
        tie,   ///< rounding the ray's own numbers changes the regions
        rule,  ///< the file's own tolerance makes it other regions than its numbers say
    };
    Verdict verdict = Verdict::decided;
    Verdict first_verdict = Verdict::decided;  ///< of the first region alone
    Sequence sequence;
    double speed = 1;  ///< length of the direction
    /// By stretch, millimetres: how far its ends move when the ray is moved by one unit in the last place. 0: the
    /// file's own tolerance puts the end elsewhere, so it is not judged.
    std::vector<double> in_unit, out_unit;
};

/// Distance errors, counted by size: 64 classes from one power of two to the next. Millions take no more memory than a
/// thousand.
class Errors {
public:
    void add(double error);
    void operator+=(const Errors& other);

    std::size_t count() const { return count_; }
    double worst() const { return worst_; }
    /// The smallest value that at least this share of them does not exceed, rounded up by 1.6 % at most; 0 of none.
    double quantile(double share) const;

    /// All that it counts, and back: {count, zeros, infinite, class, its count, class, its count, ...}.
    std::vector<std::int64_t> counts() const;
    Errors() = default;
    Errors(const std::vector<std::int64_t>& counts, double worst);

private:
    std::size_t count_ = 0, zeros_ = 0, infinite_ = 0;
    double worst_ = 0;
    std::map<int, std::size_t> classes_;  ///< by exponent and 6 bits of the fraction
};

/// So far off, no rounding puts an end, not in single precision either: head-on a four-thousandth of its distance. It
/// is on another surface, as when an operator is wrong where both answers are one region.
inline constexpr double misplaced_ulps = 0x1p40;

/// Of one variant on one workload, or summed over a family's scenes.
struct Accuracy {
    std::size_t rays = 0, decided = 0, ties = 0, rule = 0;
    std::size_t unanswered = 0;  ///< rays that the method gave up, or whose scene it refused: they are not judged
    std::size_t wrong = 0;       ///< decided rays with another sequence of regions, or another first one
    std::size_t misplaced = 0;   ///< of the others those with an end that is not where it should be: see misplaced_ulps
    std::size_t rule_ends = 0;   ///< on the right ones, but not judged: the file's own tolerance moves them
    Errors error_mm, error_ulp;  ///< of every other finite end on the right ones

    void operator+=(const Accuracy& other);

    void add(const TrueRay& truth, const RayPartitions& found, Mode mode = Mode::every_partition) {
        add(truth, sequence_of(found), mode);
    }
    /// `found`: as sequence_of() and joined() make them. Of first hits only the first stretch counts, and where that
    /// begins if it does so in front of the ray's start.
    void add(const TrueRay& truth, const Sequence& found, Mode mode = Mode::every_partition);
    void add_unanswered(std::size_t count) {
        rays += count;
        unanswered += count;
    }
};

/// The smallest value that at least this share of them does not exceed; 0 of none.
double quantile(std::vector<double> values, double share);

}  // namespace csgrt::bench
