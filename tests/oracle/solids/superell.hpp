// Superellipsoid: p = v + x a + y b + z c with (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) <= 1. Powers by the standard
// library in long double: their error of some 1e-19 is far below what is asked of a solver.
#pragma once

#include "../solid.hpp"

namespace csgrt::oracle {

struct SuperellFunction {
    double e, n;

    quad terms() const { return 1 + 1 / quad(n); }
    double settled() const { return 1e-18; }
    bool convex() const { return e <= 2 && n <= 2; }  // a norm of norms
    int pieces() const { return convex() ? 1 : 48; }
    std::vector<quad> breaks(const QVec& o, const QVec& d) const {
        std::vector<quad> zeros;
        if (d.x != 0) zeros.push_back(-o.x / d.x);
        if (d.y != 0) zeros.push_back(-o.y / d.y);
        if (d.z != 0) zeros.push_back(-o.z / d.z);
        return zeros;
    }

    static quad power(quad x, long double exponent) {
        return std::pow(static_cast<long double>(absolute(x)), exponent);
    }
    /// x^(exponent - 1) with the sign of x.
    static quad slope(quad x, long double exponent) {
        if (x == 0) return 0;
        const quad s = power(x, exponent - 1);
        return x < 0 ? -s : s;
    }
    quad value(const QVec& p) const {
        return power(power(p.x, 2.0L / e) + power(p.y, 2.0L / e), static_cast<long double>(e) / n) +
               power(p.z, 2.0L / n) - 1;
    }
    QVec gradient(const QVec& p) const {
        const quad s = power(p.x, 2.0L / e) + power(p.y, 2.0L / e), rate = 2 / quad(n);
        const quad outer = s > 0 ? rate * power(s, static_cast<long double>(e) / n - 1) : quad(0);
        return {outer * slope(p.x, 2.0L / e), outer * slope(p.y, 2.0L / e), rate * slope(p.z, 2.0L / n)};
    }
};

inline ImplicitSolid implicit(const Superell& s, const QAffine& place) {
    ImplicitSolid solid;
    add_frame(solid, place, {s.a, s.b, s.c, s.v});
    solid.add_curved(SuperellFunction{s.e, s.n});
    const QAffine& w = solid.to_world;
    solid.radius = to_double(length(w.x) + length(w.y) + length(w.z));
    solid.size = solid.radius;
    return solid;
}

}  // namespace csgrt::oracle
