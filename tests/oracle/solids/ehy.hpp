// Elliptical hyperboloid: the base at v, the apex at v + h, the vertex of the asymptotic cone a distance c beyond the
// apex. With z the fraction of the height below the apex (0 there, 1 at the base) and zeta = c + z |h|, (x / r_1)^2 +
// (y / r_2)^2 = (zeta^2 - c^2) / (|h|^2 + 2 |h| c): 0 at the apex, 1 at the base. The other sheet of the hyperboloid is
// cut off half-way between the two, where zeta = 0.
#pragma once

#include "../solid.hpp"

namespace csgrt::oracle {

struct EhyFunction {
    quad height, c;
    quad terms() const { return 1 + c * c / (height * height + 2 * height * c); }
    template <class T>
    T operator()(const T& x, const T& y, const T& z) const {
        const T zeta = T(c) + T(height) * z;
        return x * x + y * y - (zeta * zeta - T(c * c)) * T(1 / (height * height + 2 * height * c));
    }
};

inline ImplicitSolid implicit(const Ehy& ehy, const QAffine& place) {
    ImplicitSolid solid;
    const quad height = length(ehy.h), c = ehy.c;
    const QVec a = unit(ehy.a), b = unit(cross(ehy.h, a));
    add_frame(solid, place, {quad(ehy.r_1) * a, quad(ehy.r_2) * b, -QVec(ehy.h), QVec(ehy.v) + QVec(ehy.h)});
    solid.add(EhyFunction{height, c});
    solid.add(PlaneFunction{{0, 0, 1}, 1});
    solid.add(PlaneFunction{{0, 0, -1}, c / height});
    const QAffine& w = solid.to_world;
    solid.center = w.point({0, 0, quad(0.5)});
    solid.radius = to_double(root(dot(w.x, w.x) + dot(w.y, w.y)) + length(w.z) / 2);
    solid.size = solid.radius;
    return solid;
}

}  // namespace csgrt::oracle
