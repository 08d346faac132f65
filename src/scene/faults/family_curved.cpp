#include <cmath>

#include "scene/faults/families.hpp"

namespace csgrt {

namespace {

/// What a length may pass another by that it was computed to equal.
constexpr double rounding = 1e-9;

/// The most that the fields of all points can add up to: each is greatest at its point. Infinite for 1 / r.
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

}  // namespace

Faults FaultsOf::operator()(const Tor& s) const {
    Faults faults;
    if (!all_finite(faults, s.v, s.h, s.r_a, s.r_h)) return faults;
    if (length(s.h) == 0) faults.push_back("the axis has length 0");
    require_positive(faults, "the radius", s.r_a);
    require_positive(faults, "the radius of the tube", s.r_h);
    if (s.r_a > 0 && s.r_h > s.r_a) {
        faults.push_back("the radius of the tube must not be greater than that of the circle");
    }
    return faults;
}

/// BRL-CAD's rule: each of the two semi-axes by itself, c and the one across it, reaches no farther along a radius than
/// the axis. The ellipse may: it is drawn without what lies in it and its mirror image. Where c points down the second
/// is not asked for.
Faults FaultsOf::operator()(const Eto& s) const {
    Faults faults;
    if (!all_finite(faults, s.v, s.n, s.c, s.r, s.r_d)) return faults;
    const bool axis = require_length(faults, "the axis", s.n),
               semi_axis = require_length(faults, "the semi-axis c", s.c);
    require_positive(faults, "the radius", s.r);
    require_positive(faults, "the semi-axis d", s.r_d);
    if (!axis || !semi_axis || !faults.empty()) return faults;
    const double along_axis = dot(unit(s.n), unit(s.c));
    const double most = s.r * (1 + rounding);
    if (length(cross(unit(s.n), s.c)) > most || s.r_d * along_axis > most)
        faults.push_back("neither semi-axis of the ellipse must reach across the axis");
    return faults;
}

Faults FaultsOf::operator()(const Superell& s) const {
    Faults faults;
    if (!all_finite(faults, s.v, s.a, s.b, s.c, s.n, s.e)) return faults;
    require_independent(faults, {"a", "b", "c"}, {s.a, s.b, s.c});
    for (const auto& [name, exponent] : {std::pair{"n", s.n}, std::pair{"e", s.e}}) {
        if (exponent >= Limits::least_exponent && exponent <= Limits::greatest_exponent) continue;
        faults.push_back(std::string("the exponent ") + name + " must be from 1/" +
                         std::to_string(std::lround(1 / Limits::least_exponent)) + " to " +
                         std::to_string(std::lround(Limits::greatest_exponent)));
    }
    return faults;
}

Faults FaultsOf::operator()(const Hrt& s) const {
    Faults faults;
    if (!all_finite(faults, s.v, s.x, s.y, s.z, s.d)) return faults;
    require_independent(faults, {"x", "y", "z"}, {s.x, s.y, s.z});
    return faults;
}

Faults FaultsOf::operator()(const Metaball& s) const {
    Faults faults;
    const bool everywhere = s.method == Metaball::Method::isopotential;
    if (!require_at_most(faults, everywhere ? "points whose fields reach everywhere" : "points", s.points.size(),
                         everywhere ? Limits::isopotential_points : Limits::metaball_points))
        return faults;
    if (s.points.empty()) return {"it has no points"};
    if (!all_finite(faults, s.threshold)) return faults;
    for (const Metaball::Point& p : s.points) {
        if (!all_finite(faults, p.position, p.strength, p.softness)) return faults;
    }
    require_positive(faults, "the threshold", s.threshold);
    for (std::size_t i = 0; i < s.points.size(); ++i) {
        const std::string of = " of point " + std::to_string(i);
        require_positive(faults, "the strength" + of, s.points[i].strength);
        if (s.method == Metaball::Method::blob) require_positive(faults, "the softness" + of, s.points[i].softness);
    }
    if (faults.empty() && greatest_field(s) < s.threshold) {
        faults.push_back("the fields of its points nowhere add up to the threshold");
    }
    return faults;
}

}  // namespace csgrt
