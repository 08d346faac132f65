// Tight boxes: the declarations that the files of this folder share. A tight box holds everything that a ray can hit of
// one solid.
#pragma once

#include <cmath>

#include <csgrt/scene.hpp>

#include "compile/linear.hpp"

namespace csgrt {

/// Half the size of an ellipsoid's box. The columns of `axes` are the semi-axes; for an ellipse one column is 0.
inline Wide half_size(const WideMatrix& axes) {
    // Most axes are parallel to the world's, and hypot of three numbers takes long.
    const auto length = [](long double x, long double y, long double z) {
        const int parts = (x != 0) + (y != 0) + (z != 0);
        return parts > 1 ? std::hypot(x, y, z) : std::fabs(x + y + z);
    };
    return {length(axes[0].x, axes[1].x, axes[2].x), length(axes[0].y, axes[1].y, axes[2].y),
            length(axes[0].z, axes[1].z, axes[2].z)};
}

inline Box box_around(const Wide& center, const Wide& half) { return {narrow(center - half), narrow(center + half)}; }

inline Box ellipse_box(const Matrix& m, const Wide& center, const Wide& a, const Wide& b) {
    return box_around(transform_point(m, center),
                      half_size({transform_direction(m, a), transform_direction(m, b), Wide(0)}));
}

inline Box parallelogram_box(const Matrix& m, const Wide& center, const Wide& a, const Wide& b) {
    return box_around(transform_point(m, center),
                      glm::abs(transform_direction(m, a)) + glm::abs(transform_direction(m, b)));
}

/// The box of a solid under the matrix `m`, before it is rounded outward (see solid_box). bounds.cpp has ell, tgc,
/// arbs, half, tor and ehy; support_box.hpp makes boxes from support functions.
struct Tight {
    const Matrix& m;

    Box operator()(const Ell& s) const;
    Box operator()(const Tgc& s) const;
    Box operator()(const Arb& s) const;
    Box operator()(const Arbn& s) const;
    Box operator()(const Half& s) const;
    Box operator()(const Tor& s) const;
    Box operator()(const Ehy& s) const;
    Box operator()(const Part& s) const;
    Box operator()(const Epa& s) const;
    Box operator()(const Rpc& s) const;
    Box operator()(const Rhc& s) const;
    Box operator()(const Eto& s) const;
    Box operator()(const Hyp& s) const;
    Box operator()(const Superell& s) const;
    Box operator()(const Hrt& s) const;
    Box operator()(const Metaball& s) const;
    Box operator()(const Pipe& s) const;
    Box operator()(const Cline& s) const;
    Box operator()(const Bot& s) const;
    Box operator()(const Ars& s) const;
    Box operator()(const Nmg& s) const;
    Box operator()(const Ebm& s) const;
    Box operator()(const Vol& s) const;
    Box operator()(const Dsp& s) const;
    Box operator()(const Extrude& s) const;
    Box operator()(const Revolve& s) const;
    Box operator()(const Unsupported& s) const;
};

}  // namespace csgrt
