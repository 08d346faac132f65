#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "compare.hpp"
#include "cli/output.hpp"
#include "cli/text/partitions.hpp"
#include "cli/progress.hpp"

namespace csgrt::cli {

namespace {

/// The rays that differ in one respect: their number, and the worst of them.
struct Tally {
    std::uint64_t rays = 0, worst_ray = 0;
    double worst = -1;

    /// Adds a ray. `apart`: the ray's largest difference; 0 or less if it has none.
    void add(std::uint64_t ray, double apart) {
        if (!(apart > 0)) return;
        ++rays;
        if (apart > worst) {
            worst = apart;
            worst_ray = ray;
        }
    }
};

/// The distance of two numbers. 0 only if their bits are the same: zeros of different signs have a distance above 0.
double apart(double a, double b) {
    if (std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b)) return 0;
    double difference = std::abs(a - b);
    if (std::isnan(difference)) return std::numeric_limits<double>::infinity();
    return std::max(difference, std::numeric_limits<double>::denorm_min());
}

class Comparison {
public:
    explicit Comparison(std::optional<double> tolerance) : tolerance_(tolerance) {}

    void add(const TextRay& a, const TextRay& b) {
        ++rays_;
        if (a.index != b.index) {
            numbers_.add(a.index, 1);
        } else if (!same_regions(a, b)) {
            sequences_.add(a.index, 1);
        } else {
            compare_partitions(a, b);
        }
        compare_overlaps(a, b);
    }

    bool differs() const {
        bool counted = numbers_.rays || sequences_.rays || distances_.rays || overlaps_.rays;
        return counted || (!tolerance_ && (normals_.rays || solids_.rays));
    }

    std::string report() const {
        std::string text = counted(rays_, "ray") + " compared\n";
        auto row = [&text](const Tally& tally, const char* what, bool measured, const char* remark = "") {
            if (!tally.rays) return;
            text += counted(tally.rays, "ray") + " with " + what + remark;
            if (measured) {
                text += ", by at most ";
                append_number(text, tally.worst);
            }
            text += measured ? ": ray " : ", the first is ray ";
            text += std::to_string(tally.worst_ray) + "\n";
        };
        const char* remark = tolerance_ ? " (not counted under --tolerance)" : "";
        row(numbers_, "other numbers", false);
        row(sequences_, "other regions", false);
        row(distances_, "other distances", true);
        row(overlaps_, "other overlaps", false);
        row(normals_, "other normals", true, remark);
        row(solids_, "other solids", false, remark);
        return text;
    }

private:
    double beyond(double a, double b) const {
        double distance = apart(a, b);
        return tolerance_ && distance <= *tolerance_ ? 0 : distance;
    }

    static bool same_regions(const TextRay& a, const TextRay& b) {
        return std::equal(a.partitions.begin(), a.partitions.end(), b.partitions.begin(), b.partitions.end(),
                          [](const auto& p, const auto& q) { return p.region == q.region; });
    }

    void compare_partitions(const TextRay& a, const TextRay& b) {
        double distance = 0, normal = 0, solid = 0;
        for (std::size_t i = 0; i < a.partitions.size(); ++i) {
            const auto &p = a.partitions[i], &q = b.partitions[i];
            distance = std::max({distance, beyond(p.in, q.in), beyond(p.out, q.out)});
            for (std::size_t k = 0; k < p.normals.size(); ++k)
                normal = std::max(normal, apart(p.normals[k], q.normals[k]));
            if (p.solids != q.solids) solid = 1;
        }
        distances_.add(a.index, distance);
        normals_.add(a.index, normal);
        solids_.add(a.index, solid);
    }

    void compare_overlaps(const TextRay& a, const TextRay& b) {
        bool same =
            std::equal(a.overlaps.begin(), a.overlaps.end(), b.overlaps.begin(), b.overlaps.end(),
                       [this](const auto& p, const auto& q) {
                           return p.regions == q.regions && beyond(p.in, q.in) <= 0 && beyond(p.out, q.out) <= 0;
                       });
        overlaps_.add(a.index, same ? 0 : 1);
    }

    std::optional<double> tolerance_;
    std::uint64_t rays_ = 0;
    Tally numbers_, sequences_, distances_, overlaps_, normals_, solids_;
};

}  // namespace

Status compare_partitions(const CompareArguments& arguments) {
    PartitionReader first(arguments.first), second(arguments.second);
    Comparison comparison(arguments.tolerance);
    std::uint64_t surplus = 0;
    bool first_longer = false;
    {
        Progress progress;
        progress.stage("comparing");
        TextRay a, b;
        for (;;) {
            bool more = first.next(a), other_more = second.next(b);
            if (more && other_more) {
                comparison.add(a, b);
                continue;
            }
            if (!more && !other_more) break;
            ++surplus;
            first_longer = more;
        }
    }
    std::string text;
    if (surplus)
        text = counted(surplus, "ray") + " more in " + (first_longer ? arguments.first : arguments.second) + "\n";
    bool differs = surplus || comparison.differs();
    if (!differs) text = arguments.tolerance ? "equal within the tolerance\n" : "equal\n";
    print(comparison.report() + text);
    return differs ? Status::differs : Status::ok;
}

}  // namespace csgrt::cli
