#include "truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace csgrt::bench {
namespace {

constexpr double ulp = 0x1p-52;

double length(const Vec3& v) { return std::hypot(v.x, v.y, v.z); }

Settings exact(unsigned threads) {
    Settings settings;
    settings.threads = threads;
    settings.reference = true;
    settings.precision = Precision::quad;
    settings.tolerance_rule = Tolerance::surfaces;
    return settings;
}

std::vector<Sequence> sequences(Renderer& renderer, const std::vector<Ray>& rays) {
    std::vector<Sequence> all;
    for (const RayPartitions& found : renderer.shoot(rays)) all.push_back(sequence_of(found));
    return all;
}

/// How far from the world's origin the bounded part of the scene reaches.
double reach(const Box& box) {
    const double far = std::hypot(std::max(std::abs(box.low.x), std::abs(box.high.x)),
                                  std::max(std::abs(box.low.y), std::abs(box.high.y)),
                                  std::max(std::abs(box.low.z), std::abs(box.high.z)));
    return std::isfinite(far) ? far : 0;
}

/// Whether an end of a stretch moved by an eighth of the stretch or more: rounding decides whether the stretch is
/// there, or which surface ends it.
bool is_elsewhere(const Stretch& moved, const Stretch& was) {
    const double limit = (was.out - was.in) / 8;
    return std::abs(moved.in - was.in) >= limit || std::abs(moved.out - was.out) >= limit;
}

}  // namespace

struct Judge::Impl {
    Renderer judge, coarse;
    std::optional<Renderer> by_rule;
    double far = 0;

    Impl(const Scene& scene, const std::vector<std::string>& objects, const Settings& settings)
        : judge(scene, objects, settings),
          coarse(scene, objects, with_length(settings, 4 * judge.statistics().tolerance)),
          far(reach(judge.model().bounds())) {
        if (scene.tolerance > 0) by_rule.emplace(scene, objects, with_length(settings, -1));
    }
    static Settings with_length(Settings settings, double tolerance) {
        settings.tolerance_rule = Tolerance::length;
        settings.tolerance = tolerance;
        return settings;
    }
    void leave_out_rule(const std::vector<Ray>& rays, std::vector<TrueRay>& truth);
};

/// Where the file's own tolerance says something else than its numbers do, there is no one truth.
void Judge::Impl::leave_out_rule(const std::vector<Ray>& rays, std::vector<TrueRay>& truth) {
    const std::vector<Sequence> found = sequences(*by_rule, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        TrueRay& t = truth[i];
        const auto hold = [&](TrueRay::Verdict& verdict, bool same) {
            if (verdict == TrueRay::Verdict::decided && !same) verdict = TrueRay::Verdict::rule;
        };
        hold(t.first_verdict, same_first(found[i], t.sequence));
        hold(t.verdict, same_regions(found[i], t.sequence));
        // Of a ray whose first region alone is decided, the first stretch's begin.
        const std::size_t stretches = t.verdict == TrueRay::Verdict::decided ? t.sequence.size() : 1;
        for (std::size_t k = 0; k < std::min({stretches, t.sequence.size(), found[i].size()}); ++k) {
            if (found[i][k].in != t.sequence[k].in) t.in_unit[k] = 0;
            if (found[i][k].out != t.sequence[k].out) t.out_unit[k] = 0;
        }
    }
}

Judge::Judge(const Scene& scene, const std::vector<std::string>& objects, unsigned threads)
    : impl_(std::make_unique<Impl>(scene, objects, exact(threads))) {}
Judge::~Judge() = default;
Judge::Judge(Judge&&) noexcept = default;

std::vector<TrueRay> Judge::true_rays(const std::vector<Ray>& rays) {
    std::vector<TrueRay> truth(rays.size());
    std::vector<double> size(rays.size());
    const std::vector<Sequence> base = sequences(impl_->judge, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        TrueRay& t = truth[i];
        t.sequence = base[i];
        t.speed = length(rays[i].direction);
        size[i] = length(rays[i].origin) + impl_->far;
        for (const Stretch& s : t.sequence) {
            t.in_unit.push_back(ulp * std::abs(s.in) * t.speed);
            t.out_unit.push_back(ulp * std::abs(s.out) * t.speed);
        }
    }
    const auto hold_against = [&](const std::vector<Sequence>& other) {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (!same_first(other[i], base[i])) truth[i].first_verdict = TrueRay::Verdict::tie;
            if (!same_regions(other[i], base[i])) truth[i].verdict = TrueRay::Verdict::tie;
        }
    };

    hold_against(sequences(impl_->coarse, rays));
    constexpr std::array<Vec3, 4> corners{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
    for (const Vec3& corner : corners) {
        std::vector<Ray> shifted = rays;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const double by = shift_ulps * ulp * size[i];
            shifted[i].origin.x += by * corner.x;
            shifted[i].origin.y += by * corner.y;
            shifted[i].origin.z += by * corner.z;
        }
        const std::vector<Sequence> moved = sequences(impl_->judge, shifted);
        hold_against(moved);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            TrueRay& t = truth[i];
            const auto widen = [&](double& unit, double at, double from) {
                if (std::isfinite(from)) unit = std::max(unit, std::abs(at - from) * t.speed / shift_ulps);
            };
            const std::size_t known = t.verdict == TrueRay::Verdict::decided         ? t.sequence.size()
                                      : t.first_verdict == TrueRay::Verdict::decided ? 1
                                                                                     : 0;
            for (std::size_t k = 0; k < std::min(known, t.sequence.size()); ++k) {
                if (is_elsewhere(moved[i][k], t.sequence[k])) {
                    if (k == 0) t.first_verdict = TrueRay::Verdict::tie;
                    t.verdict = TrueRay::Verdict::tie;
                }
                widen(t.in_unit[k], moved[i][k].in, t.sequence[k].in);
                widen(t.out_unit[k], moved[i][k].out, t.sequence[k].out);
            }
        }
    }
    if (impl_->by_rule) impl_->leave_out_rule(rays, truth);
    return truth;
}

}  // namespace csgrt::bench
