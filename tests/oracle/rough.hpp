// Two cheaper kinds of numbers than 113 bits, for quick.hpp: a double that knows how far off it may be, with which most
// questions are answered for certain; and the unevaluated sum of two doubles, for the few numbers that must be exact.
#pragma once

#include <cmath>

#include "quad.hpp"

namespace csgrt::oracle {

/// A double, and what the true number differs from it by, at most. Every operation adds its own rounding, bounded from
/// above by a bit more than half a unit in the last place; the bounds' own rounding is covered by `grown`.
struct Rough {
    double v = 0, off = 0;

    Rough() = default;
    Rough(double exact) : v(exact) {}
    Rough(double value, double error) : v(value), off(error) {}
    explicit Rough(quad x) : v(to_double(x)), off(unit_roundoff * std::abs(v)) {}
    explicit Rough(int exact) : v(exact) {}

    double least() const { return std::abs(v) - off; }  ///< of the absolute value
    double most() const { return std::abs(v) + off; }
    bool is_positive() const { return v > off; }  ///< for certain
    bool is_negative() const { return v < -off; }

    friend Rough operator+(const Rough& a, const Rough& b) { return rounded(a.v + b.v, a.off + b.off); }
    friend Rough operator-(const Rough& a, const Rough& b) { return rounded(a.v - b.v, a.off + b.off); }
    friend Rough operator-(const Rough& a) { return {-a.v, a.off}; }
    friend Rough operator*(const Rough& a, const Rough& b) {
        return rounded(a.v * b.v, std::abs(a.v) * b.off + std::abs(b.v) * a.off + a.off * b.off);
    }
    /// Only where b is not 0 for certain.
    friend Rough operator/(const Rough& a, const Rough& b) {
        const double q = a.v / b.v;
        return rounded(q, (a.off + std::abs(q) * 1.000001 * b.off) / b.least());
    }

    static constexpr double unit_roundoff = 1.2e-16;  ///< more than 2^-53

private:
    static Rough rounded(double value, double error) {
        constexpr double grown = 1.0000001, underflow = 1e-300;
        return {value, grown * (error + unit_roundoff * std::abs(value)) + underflow};
    }
};

/// high + low, |low| at most half a unit in the last place of high: 106 bits or more. Errors of operations are some
/// 2^-104 of the result (Dekker 1971, Knuth's two-sum).
struct Twofold {
    double high = 0, low = 0;

    Twofold() = default;
    Twofold(double exact) : high(exact) {}
    Twofold(double h, double l) : high(h), low(l) {}
    explicit Twofold(quad x) : high(to_double(x)), low(std::isfinite(high) ? to_double(x - quad(high)) : 0) {}
    explicit Twofold(int exact) : high(exact) {}

    quad exactly() const { return low == 0 ? quad(high) : quad(high) + quad(low); }

    friend Twofold operator+(const Twofold& a, const Twofold& b) {
        const Twofold s = sum(a.high, b.high), t = sum(a.low, b.low);
        const Twofold u = ordered_sum(s.high, s.low + t.high);
        return ordered_sum(u.high, u.low + t.low);
    }
    friend Twofold operator-(const Twofold& a) { return {-a.high, -a.low}; }
    friend Twofold operator-(const Twofold& a, const Twofold& b) { return a + -b; }
    friend Twofold operator*(const Twofold& a, const Twofold& b) {
        const Twofold p = product(a.high, b.high);
        return ordered_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
    }
    friend Twofold operator/(const Twofold& a, const Twofold& b) {
        const double first = a.high / b.high;
        const Twofold rest = a - Twofold(first) * b;
        const double second = rest.high / b.high;
        const Twofold rest2 = rest - Twofold(second) * b;
        return ordered_sum(first, second) + Twofold(rest2.high / b.high);
    }

private:
    static Twofold sum(double a, double b) {
        const double s = a + b, part = s - a;
        return {s, (a - (s - part)) + (b - part)};
    }
    static Twofold ordered_sum(double a, double b) {  // |a| >= |b|
        const double s = a + b;
        return {s, b - (s - a)};
    }
    static Twofold product(double a, double b) {
        const double p = a * b;
#ifdef __FMA__
        return {p, std::fma(a, b, -p)};
#else
        const Twofold x = halves(a), y = halves(b);
        return {p, ((x.high * y.high - p) + x.high * y.low + x.low * y.high) + x.low * y.low};
#endif
    }
    static Twofold halves(double a) {  // 26 bits each
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
struct RoughJet {
    Rough value;
    Triple<Rough> gradient;

    RoughJet() = default;
    RoughJet(quad constant) : value(constant) {}
    RoughJet(const Rough& v, const Triple<Rough>& g) : value(v), gradient(g) {}
    friend RoughJet operator+(const RoughJet& a, const RoughJet& b) {
        return {a.value + b.value, a.gradient + b.gradient};
    }
    friend RoughJet operator-(const RoughJet& a, const RoughJet& b) {
        return {a.value - b.value, a.gradient - b.gradient};
    }
    friend RoughJet operator*(const RoughJet& a, const RoughJet& b) {
        return {a.value * b.value, a.value * b.gradient + b.value * a.gradient};
    }
};

}  // namespace csgrt::oracle
