// The kernels' answers for solids that outlines make before the oracle.
#pragma once

#include <array>

#include "catch.hpp"

#include "kernels/geometry/kernel_answer.hpp"
#include "sanitized.hpp"
#include "oracle/print.hpp"
#include "oracle/rays.hpp"
#include "oracle/perturbation.hpp"
#include "oracle/sketches.hpp"

namespace csgrt {

/// A solid, what the oracle knows of it, and the points and directions in the world that mean something to it.
struct OutlineCase {
    std::string name;
    Shape shape;
    Matrix matrix = identity;
    oracle::ExactSolid solid;
    oracle::Features features;
};

/// Rays as RayMaker's (oracle/rays.hpp), at a solid that is given by its intervals.
class OutlineRays {
public:
    OutlineRays(const OutlineCase& one, oracle::Random& random) : case_(one), random_(random) {
        for (int tries = 0; tries < 40 && touched_.size() < 8; ++tries) {
            const Ray ray = ordinary(4);
            for (const auto& i : one.solid.along(ray.origin, ray.direction))
                for (const auto& end : {i.in, i.out})
                    touched_.push_back({QVec(ray.origin) + end.t * QVec(ray.direction), end.normal});
        }
    }

    Ray make(oracle::RayFamily family) {
        using oracle::RayFamily;
        switch (family) {
            case RayFamily::tangent:
                return tangent();
            case RayFamily::edge:
                return edge_ray(case_.features, size(), random_);
            case RayFamily::parallel: {
                QVec d = random_.coin() ? random_.axis() : pick(case_.features.directions);
                if (random_.below(4) == 0) {
                    const QVec axis = random_.axis();
                    d = unit(d) + quad(random_.unit()) * axis;
                }
                d = unit(d);
                const quad back = quad(random_.between(0, 5)) * size();
                return rounded(target() - back * d, d);
            }
            case RayFamily::far:
                return ordinary(1e5);
            case RayFamily::scaled: {
                const Ray ray = random_.coin()   ? tangent()
                                : random_.coin() ? edge_ray(case_.features, size(), random_)
                                                 : ordinary(3);
                return rounded(ray.origin, quad(random_.power(-6, 6)) * QVec(ray.direction));
            }
            case RayFamily::inside: {
                const QVec d = random_.direction();
                return rounded(target(), d);
            }
            default:
                return ordinary(random_.between(1.5, 5));
        }
    }

private:
    using QVec = oracle::QVec;
    using quad = oracle::quad;
    struct Touched {
        QVec point, normal;
    };

    static Ray rounded(const QVec& o, const QVec& d) { return {to_vec3(o), to_vec3(d)}; }
    quad size() const { return case_.solid.radius; }
    const QVec& pick(const std::vector<QVec>& from) { return from[random_.below(from.size())]; }
    QVec target() {
        if (!touched_.empty() && random_.coin()) {  // between two points of the surface
            const QVec p = touched_[random_.below(touched_.size())].point,
                       q = touched_[random_.below(touched_.size())].point;
            return p + quad(random_.unit()) * (q - p);
        }
        return case_.solid.center + quad(0.6) * size() * random_.in_cube();
    }
    Ray ordinary(double away) {
        const QVec o = case_.solid.center + quad(away) * size() * random_.direction();
        return rounded(o, unit(target() - o));
    }
    /// Grazes a point of the surface within 1e-3 to 1e-12 of the size, on either side.
    Ray tangent() {
        if (touched_.empty()) return ordinary(3);
        const Touched& t = touched_[random_.below(touched_.size())];
        const QVec across = oracle::any_across(t.normal), other = cross(t.normal, across);
        const double turn = random_.between(-3.2, 3.2);
        const QVec d = quad(std::cos(turn)) * across + quad(std::sin(turn)) * other;
        const QVec p = t.point + quad(random_.signed_power(-12, -3)) * size() * t.normal;
        return rounded(p - quad(random_.between(0, 5)) * size() * d, d);
    }

    const OutlineCase& case_;
    oracle::Random& random_;
    std::vector<Touched> touched_;
};

/// `make(index, random)` gives case number `index`. `known`: how many rays may be wrong, because docs/accuracy.md says
/// so.
template <class Make>
void check_outlines(const Make& make, std::size_t rays, std::uint64_t seed, std::size_t known = 0) {
    constexpr std::size_t rays_a_solid = 42;
    struct Tally {
        std::size_t rays = 0, hits = 0, ties = 0;
    };
    std::array<Tally, oracle::ray_families> tally;
    std::size_t wrong = 0, most = 0;
    double worst = 0;
    std::string worst_case;
    oracle::Random random(seed), around(seed + 1);
    for (std::size_t done = 0, index = 0; done < rays; ++index) {
        const OutlineCase one = make(index, random);
        OutlineRays maker(one, random);
        const auto solve = kernel_answer(one.shape, one.matrix);
        for (std::size_t i = 0; i < rays_a_solid && done < rays; ++i, ++done) {
            const std::size_t family = i % oracle::ray_families;
            const Ray ray = maker.make(static_cast<oracle::RayFamily>(family));
            oracle::PerturbedAnswer answer = oracle::perturb(one.solid, ray);
            const std::vector<oracle::Segment> segments = solve(ray);
            oracle::Verdict verdict = judge(one.solid, ray, answer, segments);
            if (!verdict.wrong.empty()) {
                perturb_at_random(one.solid, ray, around, answer);
                verdict = judge(one.solid, ray, answer, segments);
            }
            ++tally[family].rays;
            tally[family].hits += answer.exact.empty() ? 0 : 1;
            tally[family].ties += answer.tie ? 1 : 0;
            most = std::max(most, answer.exact.size());
            const auto told = [&] {
                return report(one.name + " (case " + std::to_string(index) + "), " + oracle::ray_family_names[family] +
                                  "\n  " + oracle::describe(one.shape, one.matrix),
                              ray, answer, segments, verdict);
            };
            if (!verdict.wrong.empty()) {
                if (wrong++ >= known && wrong <= known + 5) FAIL_CHECK(told());
            } else if (verdict.worst > worst) {
                worst = verdict.worst;
                worst_case = told();
            }
        }
    }
    std::ostringstream summary;
    for (std::size_t i = 0; i < oracle::ray_families; ++i) {
        const Tally& t = tally[i];
        summary << oracle::ray_family_names[i] << ": " << t.rays << " rays, " << t.hits << " hit, " << t.ties
                << " ties\n";
        CHECK(t.hits * 4 > t.rays);
        CHECK(t.ties * 2 < t.rays);
    }
    INFO(summary.str() << "most intervals: " << most << ", largest error: " << worst << " tolerances\n" << worst_case);
    CHECK(wrong <= known);
    CHECK(most > 2);
    CHECK(tally[static_cast<std::size_t>(oracle::RayFamily::ordinary)].ties * 100 <= rays);
    CHECK(tally[static_cast<std::size_t>(oracle::RayFamily::far)].ties * 20 <= rays);
}

}  // namespace csgrt
