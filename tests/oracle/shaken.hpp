// The judge of solids that are not a few polynomials: what outlines make. A solid is a function that gives its exact
// intervals along a line, in 113-bit arithmetic. What rounding may do to a solver is found out by moving the ray: by
// a few roundings of all that goes into the solid's place and the ray's way to it, in each coordinate of the solid's
// own frame, to the six sides and eight corners; delta is what becomes of that in the world, at most. If all meet the
// same number of intervals, the ray is decided, and an end may be off by
//
//     (1e-12 condition size + delta) x (the end's largest shift / delta) / |d| + 4 x 2^-53 |t|
//
// Otherwise, or where some end leaps by more than a thousandth of the solid (to another surface, where the ray runs
// along one), it is a tie: then what all the rays have in common must be found, and nothing that none has.
#pragma once

#include <functional>
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
};

struct ShakenAnswer {
    ExactIntervals exact;
    std::vector<ExactIntervals> shaken;
    bool tie = false;
    double delta = 0;  ///< millimetres
};

ShakenAnswer shake(const ExactSolid& solid, const Ray& ray);

/// Fourteen rays may all miss a tip that is sharper than their directions are apart. Where a verdict is in doubt many
/// more are tried, in random directions, as far as the corners.
void look_again(const ExactSolid& solid, const Ray& ray, Random& random, ShakenAnswer& answer);

Verdict judge(const ExactSolid& solid, const Ray& ray, const ShakenAnswer& answer,
              const std::vector<Segment>& segments);

std::string report(const std::string& name, const Ray& ray, const ShakenAnswer& answer,
                   const std::vector<Segment>& segments, const Verdict& verdict);

}  // namespace csgrt::oracle
