// A solid's implicit function along a ray, for interval arithmetic: less than 0 inside.
//
// Along a ray all closed forms but the superellipsoid's are polynomials of degree 6 at most. A solid is a union of
// intersections of sets where such a polynomial is negative: its function is the least of the greatest. Of a
// polynomial on [a, b] the range is taken around the middle,
//
//     f(m + h) in f(m) + f'(m) [-r, r] + f''(m)/2 [0, r^2] + ...     r = (b - a) / 2
//
// so that it is too wide by the square of r only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

#include "compile/compiled_scene.hpp"
#include "interval.hpp"

namespace csgrt::bench {

struct Polynomial {
    static constexpr int most = 6;
    int degree = 0;
    Interval c[most + 1];
    /// Where u is in `at`.
    Interval over(const Interval& at) const;
};

class RayForm {
public:
    /// Makes it that of `solid`, which must have a form (type_without_form). The ray's and the solid's numbers are
    /// taken as they stand.
    void set(const CompiledScene& scene, std::uint32_t solid, const Ray& ray);
    /// 1: everywhere on [from, to] outside; -1: inside; 0: that is not known.
    int sign(double from, double to) const;
    Interval over(double from, double to) const;

private:
    struct Powers {  ///< of a superellipsoid
        Interval o[3], d[3];
        double p = 1, q = 1, r = 1;
        Interval over(const Interval& at) const;
    };
    double shift_ = 0;  ///< the polynomials' u is t - shift
    std::vector<Polynomial> polynomials_;
    std::vector<std::size_t> group_ends_;  ///< of the intersections
    std::vector<Powers> powers_;           ///< or one of these
};

/// The first type of solid in the scene that has none of these forms; empty: all have.
std::string type_without_form(const CompiledScene& scene);
/// The first solid's type that has no bound of the distance (DistanceBounds); empty: all have.
std::string type_without_distance(const CompiledScene& scene);
/// As BRL-CAD and csgrt's files name the solids of a SOLID_x.
const char* type_name(std::uint32_t type);

}  // namespace csgrt::bench
