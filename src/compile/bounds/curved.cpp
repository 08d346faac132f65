// Boxes of solids whose extent has a closed form; blobs.cpp has the others.
#include <algorithm>
#include <cmath>

#include "compile/solids/curved_frames.hpp"
#include "compile/bounds/support_box.hpp"
#include "compile/bounds/tight_box.hpp"

namespace csgrt {

namespace {

/// The support of q <= sqrt(1 - z), z >= 0, towards (q, z): at q = s, z = 1 - s^2 with 0 <= s <= 1.
long double parabola_support(long double q, long double z) {
    const long double s = 2 * z > q ? q / (2 * z) : 1;
    return q * s + z * (1 - s * s);
}

/// The support of q <= sqrt(k (zeta^2 - c^2)), c <= zeta <= 1 + c, k = 1 / (1 + 2 c), at z = 1 + c - zeta.
long double hyperbola_support(long double q, long double z, long double c) {
    const long double k = 1 / (1 + 2 * c), steep = z * z - k * q * q;
    if (!(z > 0) || !(steep > 0)) return q;
    const long double zeta = c * z / std::sqrt(steep);
    return zeta < 1 + c ? z * (1 + c) - c * std::sqrt(steep) : q;
}

/// The maximum of a x + b y over x^p + y^p <= 1. Up to p = 1 it is at a corner, (1, 0) or (0, 1).
long double dual_norm(long double a, long double b, long double p) {
    const long double larger = std::max(a, b), smaller = std::min(a, b);
    if (!(p > 1) || smaller == 0) return larger;
    const long double dual = p / (p - 1);
    return larger * std::exp(std::log1p(std::pow(smaller / larger, dual)) / dual);
}

}  // namespace

Box Tight::operator()(const Epa& s) const {
    return support_box(m, wide(s.v), axes_of(s), [](long double x, long double y, long double z) {
        return parabola_support(std::hypot(x, y), z);
    });
}

Box Tight::operator()(const Rpc& s) const {
    return support_box(m, wide(s.v) + 0.5L * wide(s.h), axes_of(s), [](long double x, long double y, long double z) {
        return std::fabs(x) + parabola_support(std::fabs(y), z);
    });
}

Box Tight::operator()(const Rhc& s) const {
    const long double c = static_cast<long double>(s.c) / glm::length(wide(s.b));
    return support_box(m, wide(s.v) + 0.5L * wide(s.h), axes_of(s), [&](long double x, long double y, long double z) {
        return std::fabs(x) + hyperbola_support(std::fabs(y), z, c);
    });
}

// The hyperboloid is narrower than its ends.
Box Tight::operator()(const Hyp& s) const {
    const WideMatrix axes = axes_of(s);
    return united(ellipse_box(m, wide(s.v), axes[0], axes[1]), ellipse_box(m, wide(s.v) + wide(s.h), axes[0], axes[1]));
}

Box Tight::operator()(const Eto& s) const {
    const EtoFrame f = frame_of(s);
    return support_box(m, wide(s.v), f.axes, [&](long double x, long double y, long double z) {
        const auto ellipse = [&](long double out) {
            return out + std::hypot(f.long_axis * (out * f.radial + z * f.axial),
                                    f.short_axis * (z * f.radial - out * f.axial));
        };
        // The mirror image extends farther where the ellipse's top is past the axis.
        const long double out = std::hypot(x, y);
        return std::max(ellipse(out), ellipse(-out));
    });
}

Box Tight::operator()(const Part& s) const {
    const Wide ball = half_size(linear_part(m));
    return united(box_around(transform_point(m, wide(s.v)), static_cast<long double>(s.r_v) * ball),
                  box_around(transform_point(m, wide(s.v) + wide(s.h)), static_cast<long double>(s.r_h) * ball));
}

// The solid's equation is one norm within another, so the support is one dual norm within another.
Box Tight::operator()(const Superell& s) const {
    return support_box(
        m, wide(s.v), {wide(s.a), wide(s.b), wide(s.c)}, [&](long double x, long double y, long double z) {
            return dual_norm(dual_norm(std::fabs(x), std::fabs(y), 2.0L / s.e), std::fabs(z), 2.0L / s.n);
        });
}

}  // namespace csgrt
