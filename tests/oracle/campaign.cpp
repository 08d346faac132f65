#include "campaign.hpp"

#include "print.hpp"

namespace csgrt::oracle {

namespace {

/// Middles of the segments and of the gaps between them: where the oracle may have missed two roots.
std::vector<double> middles_of(const std::vector<Segment>& segments) {
    std::vector<double> middles;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        if (i > 0) middles.push_back(middle(segments[i - 1].out, segments[i].in));
        middles.push_back(middle(segments[i].in, segments[i].out));
    }
    return middles;
}

}  // namespace

Campaign run_campaign(Kind kind, std::size_t rays, std::uint64_t seed, const Solver& solver) {
    constexpr std::size_t rays_a_solid = 42, failures_kept = 5;
    Campaign campaign;
    Random random(seed);
    for (std::size_t done = 0, index = 0; done < rays; ++index) {
        const Case one = make_case(kind, index, random);
        const ImplicitSolid solid = implicit(one.shape, one.matrix);
        RayMaker maker(one.shape, solid, random);
        const Solve solve = solver(one.shape, one.matrix);
        for (std::size_t i = 0; i < rays_a_solid && done < rays; ++i, ++done) {
            const std::size_t family = i % ray_families;
            const Ray ray = maker.make(static_cast<RayFamily>(family));
            Answer answer = intersect(solid, ray);
            const std::vector<Segment> segments = solve(ray);
            Verdict verdict = judge(solid, ray, answer, segments);
            if (!verdict.wrong.empty()) {
                answer = intersect(solid, ray, middles_of(segments));
                verdict = judge(solid, ray, answer, segments);
            }
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
