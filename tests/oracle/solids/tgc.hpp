// Truncated general cone: p = v + z h + x A + y B with 0 <= z <= 1 and (x / alpha)^2 + (y / beta)^2 <= 1, where the
// semi-axes run linearly from the base to the top: alpha from |a| to |c| along the direction of a, or of c if a is 0,
// beta from |b| to |d|. (BRL-CAD's models have a and c that are parallel to 1e-7 only; it, too, takes the base's.) In
// units of the larger of the two (A, B), so that one end of each may have length 0:
//   x^2 beta^2 + y^2 alpha^2 <= alpha^2 beta^2     in general, a quartic;
//   x^2 + y^2 <= s^2                               if alpha = beta = s, a quadric.
// The ratios count as equal within 4 units in the last place: the vectors are rounded, and taking the mean of the two
// moves the surface by less than the rounding of a coordinate.
#pragma once

#include <cmath>

#include "../solid.hpp"

namespace csgrt::oracle {

struct TgcQuadric {
    quad base, top;
    quad terms() const { return 1; }
    template <class T>
    T terms_at(const T& x, const T& y, const T& z) const {
        const T s = T(base) + T(top - base) * z;
        return x * x + y * y + s * s;
    }
    template <class T>
    T operator()(const T& x, const T& y, const T& z) const {
        const T s = T(base) + T(top - base) * z;
        return x * x + y * y - s * s;
    }
};
struct TgcQuartic {
    quad a, b, c, d;
    quad terms() const { return 1; }
    template <class T>
    T terms_at(const T& x, const T& y, const T& z) const {
        const T alpha = T(a) + T(c - a) * z, beta = T(b) + T(d - b) * z, alpha2 = alpha * alpha, beta2 = beta * beta;
        return x * x * beta2 + y * y * alpha2 + alpha2 * beta2;
    }
    template <class T>
    T operator()(const T& x, const T& y, const T& z) const {
        const T alpha = T(a) + T(c - a) * z, beta = T(b) + T(d - b) * z;
        const T alpha2 = alpha * alpha, beta2 = beta * beta;
        return x * x * beta2 + y * y * alpha2 - alpha2 * beta2;
    }
};

inline ImplicitSolid implicit(const Tgc& tgc, const QAffine& place) {
    ImplicitSolid solid;
    const quad a = length(tgc.a), b = length(tgc.b), c = length(tgc.c), d = length(tgc.d);
    const quad wide = larger(a, c), deep = larger(b, d);
    const QVec x = wide / (a > 0 ? a : c) * QVec(a > 0 ? tgc.a : tgc.c),
               y = deep / (b > 0 ? b : d) * QVec(b > 0 ? tgc.b : tgc.d);
    add_frame(solid, place, {x, y, tgc.h, tgc.v});
    const quad same = 4 * 2 * quad(double_epsilon);
    if (absolute(a / wide - b / deep) <= same && absolute(c / wide - d / deep) <= same)
        solid.add(TgcQuadric{(a / wide + b / deep) / 2, (c / wide + d / deep) / 2});
    else
        solid.add(TgcQuartic{a / wide, b / deep, c / wide, d / deep});
    solid.add(PlaneFunction{{0, 0, -1}, 0});
    solid.add(PlaneFunction{{0, 0, 1}, 1});
    const QAffine& w = solid.to_world;
    solid.center = w.point({0, 0, quad(0.5)});
    solid.radius = to_double(root(dot(w.x, w.x) + dot(w.y, w.y)) + length(w.z) / 2);
    solid.size = solid.radius;
    return solid;
}

}  // namespace csgrt::oracle
