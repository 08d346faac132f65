#include <cmath>

#include "scene/faults/families.hpp"

namespace csgrt {

namespace {

/// The relative rounding error by which a length may exceed a limit that it was computed to equal.
constexpr double rounding = 1e-9;

/// An upper bound of the sum of all points' fields: each field is greatest at its point. Infinite for fields 1 / r.
double greatest_field(const Metaball& s) {
    double sum = 0;
    for (const Metaball::Point& p : s.points) {
        switch (s.method) {
            case Metaball::Method::metaball:
                sum += 1;
                break;
            case Metaball::Method::isopotential:
                return HUGE_VAL;
            case Metaball::Method::blob:
                sum += std::exp(p.softness);
                break;
        }
    }
    return sum;
}

/// Requires that the semi-axes `start` and `end` at the two ends of a tgc are parallel.
void require_parallel(Faults& faults, const char* names, const Vec3& start, const Vec3& end) {
    const double squares = dot(start, start) * dot(end, end), along = dot(start, end);
    const Vec3 across = cross(start, end);
    // This test, without a root, suffices for most tgcs.
    if (squares > 1e-280 && along > 0 && dot(across, across) < 0.25 * angle_slack * angle_slack * squares) return;
    if (length(start) == 0 || length(end) == 0) return;
    if (length(cross(unit(start), unit(end))) > angle_slack) {
        faults.push_back(std::string("the axes ") + names + " must be parallel");
    } else if (dot(unit(start), unit(end)) < 0) {
        faults.push_back(std::string("the axes ") + names + " must not point in opposite directions");
    }
}

}  // namespace

void check_further(Faults& faults, const Tgc& s) {
    if (length(s.h) == 0) faults.push_back("the height has length 0");
    const bool a = length(s.a) > 0, b = length(s.b) > 0, c = length(s.c) > 0, d = length(s.d) > 0;
    if (!a && !b && !c && !d) {
        faults.push_back("base and top are both points: a radius at one end at least must be greater than 0");
    } else if (a != b) {
        faults.push_back(std::string("the axis ") + (a ? "b" : "a") +
                         " of the base has length 0: the base is an ellipse or a point, only the top may be an edge");
    } else if (!a && c != d) {
        faults.push_back("the base is a point and the top an edge, which encloses nothing");
    } else if (faults.empty() && dependent(a ? s.a : s.c, a ? s.b : s.d, s.h)) {
        faults.push_back(a ? "the axes a and b and the height lie in one plane"
                           : "the axes c and d and the height lie in one plane");
    }
    require_parallel(faults, "a and c", s.a, s.c);
    require_parallel(faults, "b and d", s.b, s.d);
}

void check_further(Faults& faults, const Part& s) {
    if (s.r_v == 0 && s.r_h == 0) faults.push_back("the radius must be greater than 0 at one end at least");
}

void check_further(Faults& faults, const Tor& s) {
    if (s.r_a > 0 && s.r_h > s.r_a) {
        faults.push_back("the radius of the tube must not be greater than that of the circle");
    }
}

/// Checks BRL-CAD's rule: neither semi-axis, c or the one perpendicular to c, may extend beyond the axis in the
/// direction of a radius. The ellipse itself may cross the axis: then the space that is inside both the ellipse and its
/// mirror image is left out. If c points down, BRL-CAD does not check the second semi-axis.
void check_further(Faults& faults, const Eto& s) {
    if (!faults.empty()) return;
    const double along_axis = dot(unit(s.n), unit(s.c));
    const double most = s.r * (1 + rounding);
    if (length(cross(unit(s.n), s.c)) > most || s.r_d * along_axis > most)
        faults.push_back("neither semi-axis of the ellipse must reach across the axis");
}

void check_further(Faults& faults, const Metaball& s) {
    const bool everywhere = s.method == Metaball::Method::isopotential;
    const std::size_t most = everywhere ? Limits::isopotential_points : Limits::metaball_points;
    if (s.points.size() > most) {
        faults.clear();
        require_at_most(faults, everywhere ? "points whose fields reach everywhere" : "points", s.points.size(), most);
        return;
    }
    for (std::size_t i = 0; i < s.points.size() && s.method == Metaball::Method::blob; ++i) {
        if (!(s.points[i].softness > 0))
            faults.push_back("the softness of point " + std::to_string(i) + " must be greater than 0");
    }
    if (faults.empty() && greatest_field(s) < s.threshold) {
        faults.push_back("the fields of its points nowhere add up to the threshold");
    }
}

}  // namespace csgrt
