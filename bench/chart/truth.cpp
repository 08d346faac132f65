#include "truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace csgrt::bench {
namespace {

constexpr double ulp = 0x1p-52;

double length(const Vec3& v) { return std::hypot(v.x, v.y, v.z); }

Settings exact() {
    Settings settings;
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

/// Where the file's own tolerance says something else than its numbers do, there is no one truth.
void leave_out_rule(const Scene& scene, const std::vector<std::string>& objects, const std::vector<Ray>& rays,
                    std::vector<TrueRay>& truth) {
    Settings own = exact();
    own.tolerance_rule = Tolerance::length;
    Renderer renderer(scene, objects, own);
    const std::vector<Sequence> by_rule = sequences(renderer, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        TrueRay& t = truth[i];
        if (t.verdict != TrueRay::Verdict::decided) continue;
        if (!same_regions(by_rule[i], t.sequence)) {
            t.verdict = TrueRay::Verdict::rule;
            continue;
        }
        for (std::size_t k = 0; k < t.sequence.size(); ++k) {
            if (by_rule[i][k].in != t.sequence[k].in) t.in_unit[k] = 0;
            if (by_rule[i][k].out != t.sequence[k].out) t.out_unit[k] = 0;
        }
    }
}

}  // namespace

std::vector<TrueRay> true_rays(const Scene& scene, const std::vector<std::string>& objects,
                               const std::vector<Ray>& rays) {
    Renderer renderer(scene, objects, exact());
    const double far = reach(renderer.bounds());
    std::vector<TrueRay> truth(rays.size());
    std::vector<double> size(rays.size());
    const std::vector<Sequence> base = sequences(renderer, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        TrueRay& t = truth[i];
        t.sequence = base[i];
        t.speed = length(rays[i].direction);
        size[i] = length(rays[i].origin) + far;
        for (const Stretch& s : t.sequence) {
            t.in_unit.push_back(ulp * std::abs(s.in) * t.speed);
            t.out_unit.push_back(ulp * std::abs(s.out) * t.speed);
        }
    }
    const auto hold_against = [&](const std::vector<Sequence>& other) {
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (!same_regions(other[i], base[i])) truth[i].verdict = TrueRay::Verdict::tie;
    };

    {
        Settings coarser = exact();
        coarser.tolerance_rule = Tolerance::length;
        coarser.tolerance = 4 * renderer.statistics().tolerance;
        Renderer coarse(scene, objects, coarser);
        hold_against(sequences(coarse, rays));
    }
    constexpr std::array<Vec3, 4> corners{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
    for (const Vec3& corner : corners) {
        std::vector<Ray> shifted = rays;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const double by = shift_ulps * ulp * size[i];
            shifted[i].origin.x += by * corner.x;
            shifted[i].origin.y += by * corner.y;
            shifted[i].origin.z += by * corner.z;
        }
        const std::vector<Sequence> moved = sequences(renderer, shifted);
        hold_against(moved);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            TrueRay& t = truth[i];
            if (t.verdict != TrueRay::Verdict::decided) continue;
            const auto widen = [&](double& unit, double at, double from) {
                if (std::isfinite(from)) unit = std::max(unit, std::abs(at - from) * t.speed / shift_ulps);
            };
            for (std::size_t k = 0; k < t.sequence.size(); ++k) {
                widen(t.in_unit[k], moved[i][k].in, t.sequence[k].in);
                widen(t.out_unit[k], moved[i][k].out, t.sequence[k].out);
            }
        }
    }
    if (scene.tolerance > 0) leave_out_rule(scene, objects, rays, truth);
    return truth;
}

}  // namespace csgrt::bench
