// Parabolic and hyperbolic cylinders: p = v + x h + y r e + z b with e = h x b / |h x b|; 0 <= x <= 1, z >= 0 and
//   rpc  y^2 <= 1 - z
//   rhc  y^2 <= (zeta^2 - c^2) / (|b|^2 + 2 |b| c), zeta = c + (1 - z) |b| >= 0: 0 at the vertex, 1 at the base, where
//        zeta is the distance from the vertex of the asymptotes. The other branch is cut off half-way between the two.
#pragma once

#include "../solid.hpp"

namespace csgrt::oracle {

struct RpcFunction {
    quad terms() const { return 1; }
    template <class T>
    T operator()(const T&, const T& y, const T& z) const {
        return y * y + z - T(1);
    }
};
struct RhcFunction {
    quad breadth, c;
    quad terms() const { return 1 + c * c / (breadth * breadth + 2 * breadth * c); }
    template <class T>
    T operator()(const T&, const T& y, const T& z) const {
        const T zeta = T(c + breadth) - T(breadth) * z;
        return y * y - (zeta * zeta - T(c * c)) * T(1 / (breadth * breadth + 2 * breadth * c));
    }
};

template <class Cylinder>
void place_cylinder(ImplicitSolid& solid, const Cylinder& s, const QAffine& place) {
    add_frame(solid, place, {s.h, quad(s.r) * unit(cross(s.h, s.b)), s.b, s.v});
    solid.add(PlaneFunction{{0, 0, -1}, 0});
    solid.add(PlaneFunction{{-1, 0, 0}, 0});
    solid.add(PlaneFunction{{1, 0, 0}, 1});
    const QAffine& w = solid.to_world;
    solid.center = w.point({quad(0.5), 0, quad(0.5)});
    solid.radius = to_double(length(w.x) / 2 + length(w.y) + length(w.z) / 2);
    solid.size = solid.radius;
}

inline ImplicitSolid implicit(const Rpc& rpc, const QAffine& place) {
    ImplicitSolid solid;
    place_cylinder(solid, rpc, place);
    solid.add(RpcFunction{});
    return solid;
}
inline ImplicitSolid implicit(const Rhc& rhc, const QAffine& place) {
    ImplicitSolid solid;
    place_cylinder(solid, rhc, place);
    const quad breadth = length(rhc.b), c = rhc.c;
    solid.add(RhcFunction{breadth, c});
    solid.add(PlaneFunction{{0, 0, 1}, 1 + c / breadth});
    return solid;
}

}  // namespace csgrt::oracle
