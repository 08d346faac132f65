// Ellipsoid: p = v + x a + y b + z c with x^2 + y^2 + z^2 <= 1.
#pragma once

#include "../solid.hpp"

namespace csgrt::oracle {

struct EllFunction {
    quad terms() const { return 1; }
    template <class T>
    T operator()(const T& x, const T& y, const T& z) const {
        return x * x + y * y + z * z - T(1);
    }
};

inline ImplicitSolid implicit(const Ell& ell, const QAffine& place) {
    ImplicitSolid solid;
    add_frame(solid, place, {ell.a, ell.b, ell.c, ell.v});
    solid.add(EllFunction{});
    const QAffine& w = solid.to_world;
    solid.radius =
        to_double(root(dot(w.x, w.x) + dot(w.y, w.y) + dot(w.z, w.z)));  // Frobenius: holds every unit vector
    solid.size = solid.radius;
    return solid;
}

}  // namespace csgrt::oracle
