// Torus: points at most r_h away from the circle of radius r_a about v, across h. With the circle's radius as the unit
// and k = r_h / r_a: (sqrt(x^2 + y^2) - 1)^2 + z^2 <= k^2, freed of its root:
// (x^2 + y^2 + z^2 + 1 - k^2)^2 <= 4 (x^2 + y^2). The two agree for k <= 1.
#pragma once

#include "../solid.hpp"

namespace csgrt::oracle {

struct TorFunction {
    quad k;
    quad terms() const { return 4 * k; }
    /// f = (s - 2 rho) (s + 2 rho) with s = rho^2 + z^2 + 1 - k^2, whose terms are all positive: next to the pinch of a
    /// horn torus the first factor is as exact as they are small.
    template <class T>
    T terms_at(const T& x, const T& y, const T& z) const {
        const T across = x * x + y * y, both = across + z * z + T((1 - k) * (1 + k)) + 2 * root_of(across);
        return both * both;
    }
    template <class T>
    T operator()(const T& x, const T& y, const T& z) const {
        const T across = x * x + y * y;
        const T sum = across + z * z + T(1 - k * k);
        return sum * sum - T(4) * across;
    }
};

inline ImplicitSolid implicit(const Tor& tor, const QAffine& place) {
    ImplicitSolid solid;
    const QVec axis = unit(tor.h), across = any_across(axis);
    const quad r = tor.r_a, k = quad(tor.r_h) / r;
    add_frame(solid, place, {r * across, r * cross(axis, across), r * axis, tor.v});
    solid.add(TorFunction{k});
    const QAffine& w = solid.to_world;
    solid.radius = to_double((1 + k) * root(dot(w.x, w.x) + dot(w.y, w.y) + dot(w.z, w.z)));
    solid.size = solid.radius;
    return solid;
}

}  // namespace csgrt::oracle
