// Many rays at many solids of one kind, a solver's answers before the oracle, and a tally of what was met.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "judge.hpp"
#include "rays.hpp"
#include "shapes.hpp"

namespace csgrt::oracle {

struct Tally {
    std::size_t rays = 0, hits = 0, ties = 0, wrong = 0;
};
struct Campaign {
    std::array<Tally, ray_families> tally;
    std::vector<std::string> failures;  ///< the first few, to be replayed
    double worst = 0;                   ///< the largest error of an end on a decided ray, in tolerances
    std::string worst_case;

    Tally total() const {
        Tally sum;
        for (const Tally& t : tally) {
            sum.rays += t.rays;
            sum.hits += t.hits;
            sum.ties += t.ties;
            sum.wrong += t.wrong;
        }
        return sum;
    }
};

/// `solver(shape, matrix)` gives a function from a Ray to the Segments of the solid.
template <class Solver>
Campaign run_campaign(Kind kind, std::size_t rays, std::uint64_t seed, const Solver& solver) {
    constexpr std::size_t rays_a_solid = 42, failures_kept = 5;
    Campaign campaign;
    Random random(seed);
    for (std::size_t done = 0, index = 0; done < rays; ++index) {
        const Case one = make_case(kind, index, random);
        const ImplicitSolid solid = implicit(one.shape, one.matrix);
        RayMaker maker(one.shape, solid, random);
        const auto solve = solver(one.shape, one.matrix);
        for (std::size_t i = 0; i < rays_a_solid && done < rays; ++i, ++done) {
            const std::size_t family = i % ray_families;
            const Ray ray = maker.make(static_cast<RayFamily>(family));
            const Answer answer = intersect(solid, ray);
            const std::vector<Segment> segments = solve(ray);
            const Verdict verdict = judge(solid, ray, answer, segments);
            Tally& tally = campaign.tally[family];
            ++tally.rays;
            tally.hits += answer.intervals.empty() ? 0 : 1;
            tally.ties += answer.tie ? 1 : 0;
            const auto told = [&] {
                return report(one.name + ", " + ray_family_names[family] + "\n  " + describe(one.shape, one.matrix),
                              ray, answer, segments, verdict);
            };
            if (!verdict.wrong.empty()) {
                ++tally.wrong;
                if (campaign.failures.size() < failures_kept) campaign.failures.push_back(told());
            } else if (verdict.worst > campaign.worst) {
                campaign.worst = verdict.worst;
                campaign.worst_case = told();
            }
        }
    }
    return campaign;
}

}  // namespace csgrt::oracle
