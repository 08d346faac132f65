// Elliptical torus: in a half-plane through the axis, with rho the distance from it and z along it, both in units of r,
// the points around (1, 0) with
//   (u . q)^2 / C^2 + (w . q)^2 / D^2 <= 1,  q = (rho - 1, z), u the direction of c, w across it, C = |c|, D = r_d.
// That is F(rho) = A + rho B <= 0 with A and B even in rho; F(-rho) > 0 while the ellipse stays on its side of the
// axis, so A^2 - rho^2 B^2 <= 0 says the same without a root.
#pragma once

#include "../solid.hpp"

namespace csgrt::oracle {

struct EtoFunction {
    quad alpha, beta, gamma;  ///< of (rho - 1)^2, 2 (rho - 1) z, z^2, divided by the larger of 1 / C^2 and 1 / D^2
    quad one;                 ///< what the form is compared with: 1, divided likewise
    quad out, up;             ///< how far the ellipse reaches
    quad terms() const { return 4 * root(one) + alpha * out * out + 2 * absolute(beta) * out * up + gamma * up * up; }
    /// f = F(rho) F(-rho): the rounding of F(rho), whose terms stay as large as they are, times the other factor, which
    /// fades where the ellipse touches the axis.
    template <class T>
    T terms_at(const T& x, const T& y, const T& z) const {
        const T a = T(alpha), b = T(beta), c = T(gamma), rho = root_of(x * x + y * y), in = rho - 1,
                mirrored = -rho - 1;
        const T rest = c * z * z - T(one), cross = 2 * b * in * z;
        const T sum = a * in * in + (cross < 0 ? -cross : cross) + c * z * z + T(one);
        const T here = a * in * in + cross + rest, there = mirrored * (a * mirrored + 2 * b * z) + rest;
        return sum * ((here < 0 ? -here : here) + (there < 0 ? -there : there));
    }
    template <class T>
    T operator()(const T& x, const T& y, const T& z) const {
        const T rho2 = x * x + y * y;
        const T even = T(alpha) * (rho2 + T(1)) - T(2 * beta) * z + T(gamma) * z * z - T(one);
        const T odd = T(2 * beta) * z - T(2 * alpha);
        return even * even - rho2 * odd * odd;
    }
};

inline ImplicitSolid implicit(const Eto& eto, const QAffine& place) {
    ImplicitSolid solid;
    const QVec axis = unit(eto.n), across = any_across(axis), c = eto.c;
    const quad r = eto.r, along = dot(c, axis), out = length(c - along * axis);
    const quad big = length(c) / r, small = quad(eto.r_d) / r, u = out / length(c), w = along / length(c);
    add_frame(solid, place, {r * across, r * cross(axis, across), r * axis, eto.v});
    const quad least = smaller(big, small), one = least * least;
    const quad p = one / (big * big), q = one / (small * small);
    const quad reach = root(u * u * big * big + w * w * small * small),
               high = root(w * w * big * big + u * u * small * small);
    solid.add(EtoFunction{u * u * p + w * w * q, u * w * (p - q), w * w * p + u * u * q, one, reach, high});
    const QAffine& m = solid.to_world;
    solid.radius = to_double((1 + larger(big, small)) * root(dot(m.x, m.x) + dot(m.y, m.y) + dot(m.z, m.z)));
    solid.size = solid.radius;
    return solid;
}

}  // namespace csgrt::oracle
