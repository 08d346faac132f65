// Random numbers that are the same with every standard library (its distributions are not). Which number goes where
// must not be the compiler's choice, either: a call's arguments, and what an operator stands between, are computed in
// any order. What draws twice has a name for the one drawn first, or stands in braces.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include "quad.hpp"

namespace csgrt::oracle {

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// In [0, 1).
    double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// 10^x with x between the two.
    double power(double low, double high) { return std::pow(10.0, between(low, high)); }
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(unit() * static_cast<double>(count)); }
    bool coin() { return unit() < 0.5; }
    double sign() { return coin() ? 1 : -1; }
    /// power(), with either sign.
    double signed_power(double low, double high) {
        const double s = sign();
        return s * power(low, high);
    }

    /// Uniform on the unit sphere.
    QVec direction() {
        for (;;) {
            const QVec v = in_cube();
            const quad square = dot(v, v);
            if (square > quad(1e-4) && square <= 1) return oracle::unit(v);
        }
    }
    /// A vector in any direction, of the length 10^x times `unit` with x between the two.
    QVec offset(double low, double high, quad unit = 1) {
        const QVec d = direction();
        return quad(power(low, high)) * unit * d;
    }
    /// Uniform in the cube from -1 to 1.
    QVec in_cube() {
        const double x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
        return {x, y, z};
    }
    /// One of the six directions along the axes.
    QVec axis() {
        const quad s = sign();
        switch (below(3)) {
            case 0:
                return {s, 0, 0};
            case 1:
                return {0, s, 0};
            default:
                return {0, 0, s};
        }
    }

private:
    std::mt19937_64 engine_;
};

}  // namespace csgrt::oracle
