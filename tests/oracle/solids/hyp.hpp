// Hyperboloid of one sheet: p = v + h / 2 + x a + y b e + z h / 2 with e = h x a / |h x a|; the hyperbola whose vertex
// is at the neck's share in the middle (z = 0) and that reaches 1 at the ends (z = -1, 1).
#pragma once

#include "../solid.hpp"

namespace csgrt::oracle {

struct HypFunction {
    quad neck;
    quad terms() const { return 1; }
    template <class T>
    T operator()(const T& x, const T& y, const T& z) const {
        return x * x + y * y - T(neck * neck) - T(1 - neck * neck) * z * z;
    }
};

inline ImplicitSolid implicit(const Hyp& hyp, const QAffine& place) {
    ImplicitSolid solid;
    const QVec half = quad(0.5) * QVec(hyp.h);
    add_frame(solid, place, {hyp.a, quad(hyp.b) * unit(cross(hyp.h, hyp.a)), half, QVec(hyp.v) + half});
    solid.add(HypFunction{hyp.neck});
    solid.add(PlaneFunction{{0, 0, -1}, 1});
    solid.add(PlaneFunction{{0, 0, 1}, 1});
    const QAffine& w = solid.to_world;
    solid.radius = to_double(root(dot(w.x, w.x) + dot(w.y, w.y)) + length(w.z));
    solid.size = solid.radius;
    return solid;
}

}  // namespace csgrt::oracle
