// Elliptic paraboloid: p = v + x r_1 a + y r_2 b + z h with b = h x a / |h x a|; x^2 + y^2 <= 1 - z and z >= 0.
#pragma once

#include "../solid.hpp"

namespace csgrt::oracle {

struct EpaFunction {
    quad terms() const { return 1; }
    template <class T>
    T operator()(const T& x, const T& y, const T& z) const {
        return x * x + y * y + z - T(1);
    }
};

inline ImplicitSolid implicit(const Epa& epa, const QAffine& place) {
    ImplicitSolid solid;
    const QVec a = unit(epa.a), b = unit(cross(epa.h, a));
    add_frame(solid, place, {quad(epa.r_1) * a, quad(epa.r_2) * b, epa.h, epa.v});
    solid.add(EpaFunction{});
    solid.add(PlaneFunction{{0, 0, -1}, 0});
    const QAffine& w = solid.to_world;
    solid.center = w.point({0, 0, quad(0.5)});
    solid.radius = to_double(root(dot(w.x, w.x) + dot(w.y, w.y)) + length(w.z) / 2);
    solid.size = solid.radius;
    return solid;
}

}  // namespace csgrt::oracle
