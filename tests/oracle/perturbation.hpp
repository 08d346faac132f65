// The judge of solids that are not bounded by a few polynomials, such as extruded outlines. A solid is a function that
// gives its exact intervals along a line, in 113-bit arithmetic. What rounding may do to a solver is estimated by
// perturbing the ray: the judge moves it in each coordinate of the solid's own frame, to the six sides and eight
// corners of a box, by a few roundings of the numbers that go into the solid's place and the ray's way to it. Delta is
// the largest of these moves in the world. If all perturbed rays meet the same number of intervals, the ray is decided,
// and an end may be off by
//
//     (1e-12 condition size + delta) x (the end's largest shift / delta) / |d| + 4 x 2^-53 |t|
//
// Otherwise, or if some end moves by more than a thousandth of the solid's size (to another surface, where the ray runs
// along one), the ray is a tie. Then a solver must find what all the rays have in common, and nothing that none of them
// has.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

#include "judge.hpp"
#include "random.hpp"
#include "solid.hpp"

namespace csgrt::oracle {

struct ExactEnd {
    quad t;
    QVec normal;  ///< unit, outward
};
struct ExactInterval {
    ExactEnd in, out;
};
using ExactIntervals = std::vector<ExactInterval>;

struct ExactSolid {
    std::function<ExactIntervals(const QVec&, const QVec&)> along;
    QAffine frame;  ///< own frame -> world
    QVec center;
    double radius = 0, placement = 0, condition = 1;  ///< as in ImplicitSolid
    /// If it is a wedge about the own frame's z axis: the direction half-way between its sides. A wedge, or what is cut
    /// out of one, may be narrower than the gaps between the moves. So a ray along the axis is moved into both, too.
    std::optional<QVec> half_way = {};
};

struct PerturbedAnswer {
    ExactIntervals exact;
    std::vector<ExactIntervals> perturbed;  ///< one for each perturbed ray
    bool tie = false;
    double delta = 0;  ///< millimetres
};

PerturbedAnswer perturb(const ExactSolid& solid, const Ray& ray);

/// Adds many perturbed rays, in random directions, no farther than the corners. Fourteen rays may all miss a tip that
/// is narrower than the gaps between them: a test calls this before it reports an error.
void perturb_at_random(const ExactSolid& solid, const Ray& ray, Random& random, PerturbedAnswer& answer);

Verdict judge(const ExactSolid& solid, const Ray& ray, const PerturbedAnswer& answer,
              const std::vector<Segment>& segments);

std::string report(const std::string& name, const Ray& ray, const PerturbedAnswer& answer,
                   const std::vector<Segment>& segments, const Verdict& verdict);

}  // namespace csgrt::oracle
