// Many rays at many solids of one kind, a solver's answers before the oracle, and a tally of what was met.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
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

using Solve = std::function<std::vector<Segment>(const Ray&)>;  ///< the segments of one solid along a ray
using Solver = std::function<Solve(const Shape&, const Matrix&)>;

Campaign run_campaign(Kind kind, std::size_t rays, std::uint64_t seed, const Solver& solver);

}  // namespace csgrt::oracle
