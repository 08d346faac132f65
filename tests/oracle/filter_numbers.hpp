// The numbers of the floating-point filter (filtered_solid.hpp), both faster than 113-bit arithmetic: a double with a
// bound of its error, which decides most comparisons for certain, and a double-double, the unevaluated sum of two
// doubles, for the few numbers that need more bits.
#pragma once

#include <cmath>

#include "quad.hpp"

namespace csgrt::oracle {

/// A double, and a bound of its difference from the true number (running error analysis). Each operation adds its own
/// rounding error, at most a bit more than half a unit in the last place. The factor `grown` covers the rounding of the
/// bounds.
struct BoundedDouble {
    double v = 0, error = 0;

    BoundedDouble() = default;
    BoundedDouble(double exact) : v(exact) {}
    BoundedDouble(double value, double largest_error) : v(value), error(largest_error) {}
    explicit BoundedDouble(quad x) : v(to_double(x)), error(unit_roundoff * std::abs(v)) {}
    explicit BoundedDouble(int exact) : v(exact) {}

    double least() const { return std::abs(v) - error; }  ///< bounds of the absolute value
    double most() const { return std::abs(v) + error; }
    bool is_positive() const { return v > error; }  ///< for certain
    bool is_negative() const { return v < -error; }

    friend BoundedDouble operator+(const BoundedDouble& a, const BoundedDouble& b) {
        return rounded(a.v + b.v, a.error + b.error);
    }
    friend BoundedDouble operator-(const BoundedDouble& a, const BoundedDouble& b) {
        return rounded(a.v - b.v, a.error + b.error);
    }
    friend BoundedDouble operator-(const BoundedDouble& a) { return {-a.v, a.error}; }
    friend BoundedDouble operator*(const BoundedDouble& a, const BoundedDouble& b) {
        return rounded(a.v * b.v, std::abs(a.v) * b.error + std::abs(b.v) * a.error + a.error * b.error);
    }
    /// Only where b is not 0 for certain.
    friend BoundedDouble operator/(const BoundedDouble& a, const BoundedDouble& b) {
        const double q = a.v / b.v;
        return rounded(q, (a.error + std::abs(q) * 1.000001 * b.error) / b.least());
    }

    static constexpr double unit_roundoff = 1.2e-16;  ///< more than 2^-53

private:
    static BoundedDouble rounded(double value, double error) {
        constexpr double grown = 1.0000001, underflow = 1e-300;
        return {value, grown * (error + unit_roundoff * std::abs(value)) + underflow};
    }
};

/// high + low, |low| at most half a unit in the last place of high: 106 bits or more. Errors of operations are some
/// 2^-104 of the result (Dekker 1971, Knuth's two-sum).
struct DoubleDouble {
    double high = 0, low = 0;

    DoubleDouble() = default;
    DoubleDouble(double exact) : high(exact) {}
    DoubleDouble(double h, double l) : high(h), low(l) {}
    explicit DoubleDouble(quad x) : high(to_double(x)), low(std::isfinite(high) ? to_double(x - quad(high)) : 0) {}
    explicit DoubleDouble(int exact) : high(exact) {}

    quad exactly() const { return low == 0 ? quad(high) : quad(high) + quad(low); }

    friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
        const DoubleDouble s = sum(a.high, b.high), t = sum(a.low, b.low);
        const DoubleDouble u = ordered_sum(s.high, s.low + t.high);
        return ordered_sum(u.high, u.low + t.low);
    }
    friend DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }
    friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
    friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
        const DoubleDouble p = product(a.high, b.high);
        return ordered_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
    }
    friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
        const double first = a.high / b.high;
        const DoubleDouble rest = a - DoubleDouble(first) * b;
        const double second = rest.high / b.high;
        const DoubleDouble rest2 = rest - DoubleDouble(second) * b;
        return ordered_sum(first, second) + DoubleDouble(rest2.high / b.high);
    }

private:
    static DoubleDouble sum(double a, double b) {
        const double s = a + b, part = s - a;
        return {s, (a - (s - part)) + (b - part)};
    }
    static DoubleDouble ordered_sum(double a, double b) {  // |a| >= |b|
        const double s = a + b;
        return {s, b - (s - a)};
    }
    static DoubleDouble product(double a, double b) {
        const double p = a * b;
#ifdef __FMA__
        return {p, std::fma(a, b, -p)};
#else
        const DoubleDouble x = halves(a), y = halves(b);
        return {p, ((x.high * y.high - p) + x.high * y.low + x.low * y.high) + x.low * y.low};
#endif
    }
    static DoubleDouble halves(double a) {  // 26 bits each
        const double c = 134'217'729.0 * a, h = c - (c - a);
        return {h, a - h};
    }
};

template <class N>
struct Triple {
    N x, y, z;

    friend Triple operator+(const Triple& a, const Triple& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Triple operator-(const Triple& a, const Triple& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Triple operator*(const N& s, const Triple& a) { return {s * a.x, s * a.y, s * a.z}; }
    friend N dot(const Triple& a, const Triple& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
};
template <class N>
Triple<N> triple(const QVec& v) {
    return {N(v.x), N(v.y), N(v.z)};
}
template <class N>
Triple<N> triple(const Vec3& v) {
    return {N(v.x), N(v.y), N(v.z)};
}

/// A value and its gradient, for functions of solids.
struct BoundedJet {
    BoundedDouble value;
    Triple<BoundedDouble> gradient;

    BoundedJet() = default;
    BoundedJet(quad constant) : value(constant) {}
    BoundedJet(const BoundedDouble& v, const Triple<BoundedDouble>& g) : value(v), gradient(g) {}
    friend BoundedJet operator+(const BoundedJet& a, const BoundedJet& b) {
        return {a.value + b.value, a.gradient + b.gradient};
    }
    friend BoundedJet operator-(const BoundedJet& a, const BoundedJet& b) {
        return {a.value - b.value, a.gradient - b.gradient};
    }
    friend BoundedJet operator*(const BoundedJet& a, const BoundedJet& b) {
        return {a.value * b.value, a.value * b.gradient + b.value * a.gradient};
    }
};

}  // namespace csgrt::oracle
