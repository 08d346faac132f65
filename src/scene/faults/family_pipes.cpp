#include <algorithm>
#include <cmath>

#include "scene/faults/families.hpp"

namespace csgrt {

namespace {

/// The relative rounding error by which a length may exceed a limit that it was computed to equal.
constexpr double rounding = 1e-9;

/// The sine of the angle below which two directions count as equal or opposite.
constexpr double straight = 1e-9;

/// The length that a bend's arc takes of the straight part on each of its sides. 0 where the pipe runs straight on.
double tangent_at(Faults& faults, const Pipe& s, std::size_t i) {
    const Pipe::Point& p = s.points[i];
    const Vec3 into = unit(p.position - s.points[i - 1].position), out = unit(s.points[i + 1].position - p.position);
    const double sine = length(cross(into, out)), cosine = dot(into, out);
    const std::string at = " at point " + std::to_string(i);
    if (sine <= straight) {
        if (cosine < 0) faults.push_back("it turns back on itself" + at);
        return 0;
    }
    if (!(p.bend >= p.outer / 2 * (1 - rounding))) {
        faults.push_back("the bend" + at + " must have a radius of half the outer diameter or more");
    }
    return p.bend * (cosine > -0.5 ? sine / (1 + cosine) : (1 - cosine) / sine);  // as in flatten/solid_parts.cpp
}

}  // namespace

void check_further(Faults& faults, const Pipe& s) {
    for (std::size_t i = 0; i < s.points.size(); ++i) {
        const Pipe::Point& p = s.points[i];
        if (p.outer > 0 && p.inner >= p.outer)
            faults.push_back("the inner diameter at point " + std::to_string(i) + " must be less than the outer one");
        if (i > 0 && length(p.position - s.points[i - 1].position) == 0) {
            faults.push_back("points " + std::to_string(i - 1) + " and " + std::to_string(i) + " are one place");
        }
    }
    if (!faults.empty()) return;
    double before = 0;  // the length that the last point's bend takes of the straight part after it
    for (std::size_t i = 1; i < s.points.size(); ++i) {
        const double tangent = i + 1 < s.points.size() ? tangent_at(faults, s, i) : 0;
        const double apart = length(s.points[i].position - s.points[i - 1].position);
        if (before + tangent > apart * (1 + rounding)) {
            faults.push_back("the bends leave no room between points " + std::to_string(i - 1) + " and " +
                             std::to_string(i));
        }
        before = tangent;
    }
}

}  // namespace csgrt
