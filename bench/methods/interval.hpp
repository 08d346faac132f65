// Interval arithmetic (Moore 1966), rounded outward: every real result for numbers of the operands is in the result.
#pragma once

#include <algorithm>
#include <cmath>

namespace csgrt::bench {

struct Interval {
    double low = 0, high = 0;
    Interval() = default;
    Interval(double at) : low(at), high(at) {}
    Interval(double from, double to) : low(from), high(to) {}
    bool contains(double x) const { return low <= x && x <= high; }
};

/// A result rounded to nearest is off by half a unit in its last place, which is at most 2^-53 of it; the constant
/// serves where it is subnormal.
inline double round_down(double x) { return x - (std::abs(x) * 0x1p-52 + 0x1p-1060); }
inline double round_up(double x) { return x + (std::abs(x) * 0x1p-52 + 0x1p-1060); }

inline Interval operator-(const Interval& a) { return {-a.high, -a.low}; }
inline Interval operator+(const Interval& a, const Interval& b) {
    return {round_down(a.low + b.low), round_up(a.high + b.high)};
}
inline Interval operator-(const Interval& a, const Interval& b) { return a + -b; }
inline Interval operator*(const Interval& a, const Interval& b) {
    const double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
    return {round_down(std::min(std::min(p, q), std::min(r, s))), round_up(std::max(std::max(p, q), std::max(r, s)))};
}
/// The least and the greatest size of its numbers.
inline Interval size_of(const Interval& a) {
    if (a.low >= 0) return a;
    if (a.high <= 0) return -a;
    return {0, std::max(-a.low, a.high)};
}
inline Interval square(const Interval& a) {
    const Interval s = size_of(a);
    return {std::max(0.0, round_down(s.low * s.low)), round_up(s.high * s.high)};
}
/// Of numbers that are not negative. The C library's pow is off by less than 2^-51 of the result.
inline Interval power(const Interval& a, double exponent) {
    const double low = std::pow(std::max(0.0, a.low), exponent), high = std::pow(a.high, exponent);
    return {std::max(0.0, low * (1 - 0x1p-50) - 0x1p-1060), high * (1 + 0x1p-50) + 0x1p-1060};
}

}  // namespace csgrt::bench
