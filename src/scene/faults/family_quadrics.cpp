#include "scene/faults/families.hpp"

namespace csgrt {

namespace {

/// The end of a tgc that tapers along `end` must keep the direction of `start`.
void require_parallel(Faults& faults, const char* names, const Vec3& start, const Vec3& end) {
    const double squares = dot(start, start) * dot(end, end), along = dot(start, end);
    const Vec3 across = cross(start, end);
    // Far from a limit no root need be taken.
    if (squares > 1e-280 && along > 0 && dot(across, across) < 0.25 * angle_slack * angle_slack * squares) return;
    if (length(start) == 0 || length(end) == 0) return;
    if (length(cross(unit(start), unit(end))) > angle_slack) {
        faults.push_back(std::string("the axes ") + names + " must be parallel");
    } else if (dot(unit(start), unit(end)) < 0) {
        faults.push_back(std::string("the axes ") + names + " must not point in opposite directions");
    }
}

}  // namespace

Faults FaultsOf::operator()(const Ell& s) const {
    Faults faults;
    if (!all_finite(faults, s.v, s.a, s.b, s.c)) return faults;
    require_independent(faults, {"a", "b", "c"}, {s.a, s.b, s.c});
    return faults;
}

Faults FaultsOf::operator()(const Tgc& s) const {
    Faults faults;
    if (!all_finite(faults, s.v, s.h, s.a, s.b, s.c, s.d)) return faults;
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
    return faults;
}

Faults FaultsOf::operator()(const Ehy& s) const {
    Faults faults;
    if (!all_finite(faults, s.v, s.h, s.a, s.r_1, s.r_2, s.c)) return faults;
    require_length(faults, "the height", s.h);
    require_direction_across(faults, "a", s.a, s.h);
    require_positive(faults, "the semi-axis r1", s.r_1);
    require_positive(faults, "the semi-axis r2", s.r_2);
    require_positive(faults, "c, the distance from the apex to the asymptotes,", s.c);
    return faults;
}

Faults FaultsOf::operator()(const Part& s) const {
    Faults faults;
    if (!all_finite(faults, s.v, s.h, s.r_v, s.r_h)) return faults;  // a height of 0 is a ball
    require_not_negative(faults, "the radius", s.r_v);
    require_not_negative(faults, "the radius at the top", s.r_h);
    if (s.r_v == 0 && s.r_h == 0) faults.push_back("the radius must be greater than 0 at one end at least");
    return faults;
}

Faults FaultsOf::operator()(const Epa& s) const {
    Faults faults;
    if (!all_finite(faults, s.v, s.h, s.a, s.r_1, s.r_2)) return faults;
    require_length(faults, "the height", s.h);
    require_direction_across(faults, "a", s.a, s.h);
    require_positive(faults, "the semi-axis r1", s.r_1);
    require_positive(faults, "the semi-axis r2", s.r_2);
    return faults;
}

Faults FaultsOf::operator()(const Rpc& s) const {
    Faults faults;
    if (!all_finite(faults, s.v, s.h, s.b, s.r)) return faults;
    require_length(faults, "the height", s.h);
    require_length(faults, "the vector b", s.b);
    require_perpendicular(faults, "the vector b", s.b, "the height", s.h);
    require_positive(faults, "half the width", s.r);
    return faults;
}

Faults FaultsOf::operator()(const Rhc& s) const {
    Faults faults;
    if (!all_finite(faults, s.v, s.h, s.b, s.r, s.c)) return faults;
    faults = (*this)(Rpc{s.v, s.h, s.b, s.r});
    require_positive(faults, "c, the distance from the vertex to the asymptotes,", s.c);
    return faults;
}

Faults FaultsOf::operator()(const Hyp& s) const {
    Faults faults;
    if (!all_finite(faults, s.v, s.h, s.a, s.b, s.neck)) return faults;
    require_length(faults, "the height", s.h);
    require_length(faults, "the semi-axis a", s.a);
    require_perpendicular(faults, "the semi-axis a", s.a, "the height", s.h);
    require_positive(faults, "the semi-axis b", s.b);
    if (!(s.neck > 0 && s.neck < 1)) faults.push_back("the neck, a share of a and b, must lie between 0 and 1");
    return faults;
}

}  // namespace csgrt
