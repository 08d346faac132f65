// Puts a solver's segments before the oracle.
//
// Decided rays: the same number of segments; each end within the tolerance of intersect.hpp. Ties: every segment lies
// possibly inside (its midpoint), every certain interval is found, every end lies on a surface of the solid.
// All rays: segments in order and not overlapping; normals unit, outward, and along the gradient within 1e-9 x
// condition plus what the normal itself varies over the displacement that the hit may have (curvature; at an apex,
// everything).
#pragma once

#include <string>
#include <vector>

#include "intersect.hpp"

namespace csgrt::oracle {

/// What a solver says about one interval of a ray in a solid.
struct Segment {
    double in = 0, out = 0;
    Vec3 in_normal, out_normal;  ///< unit, outward
};

struct Verdict {
    std::string wrong;  ///< what is wrong; empty: nothing
    double worst = 0;   ///< the largest error of an end, in tolerances; decided rays only
};

inline constexpr double normal_precision = 1e-9;

/// A point between two ends, of which one or both may be infinite.
double middle(double in, double out);

Verdict judge(const ImplicitSolid& solid, const Ray& ray, const Answer& answer, const std::vector<Segment>& segments);

/// Everything about one ray that failed.
std::string report(const std::string& what, const Ray& ray, const Answer& answer, const std::vector<Segment>& segments,
                   const Verdict& verdict);

}  // namespace csgrt::oracle
