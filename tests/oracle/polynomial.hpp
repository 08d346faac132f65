// Polynomials in one variable up to degree 4, and all their real roots in an interval.
//
// Roots are isolated by the derivative chain: between two neighbouring roots of p' the polynomial is monotone, so it
// has one root there if its ends differ in sign, and none otherwise. Each is refined by Newton's method kept inside its
// bracket, first in double (cheap), then in 113 bits; a bisection takes over where Newton does not settle.
#pragma once

#include <array>
#include <cstddef>

#include "quad.hpp"

namespace csgrt::oracle {

/// N: a type of numbers that a quad turns into.
template <class N>
struct PolynomialOf {
    using Polynomial = PolynomialOf;
    static constexpr int max_degree = 4;
    std::array<N, max_degree + 1> c{};  ///< c[i] belongs to x^i
    int degree = 0;                     ///< c[i] is 0 beyond it; the leading one may be 0, too

    PolynomialOf() = default;
    PolynomialOf(quad constant) { c[0] = N(constant); }
    static Polynomial linear(const N& at_zero, const N& slope) {
        Polynomial p;
        p.c[0] = at_zero;
        p.c[1] = slope;
        p.degree = 1;
        return p;
    }

    N operator()(const N& x) const {
        N sum = c[static_cast<std::size_t>(degree)];
        for (int i = degree; i-- > 0;) sum = sum * x + c[static_cast<std::size_t>(i)];
        return sum;
    }
    Polynomial derivative() const {
        Polynomial d;
        d.degree = degree > 0 ? degree - 1 : 0;
        for (int i = 1; i <= degree; ++i) d.c[static_cast<std::size_t>(i - 1)] = N(i) * c[static_cast<std::size_t>(i)];
        return d;
    }

    friend Polynomial operator+(const Polynomial& a, const Polynomial& b) {
        Polynomial result;
        result.degree = a.degree > b.degree ? a.degree : b.degree;
        const auto terms = static_cast<std::size_t>(result.degree) + 1;
        for (std::size_t i = 0; i < terms; ++i) result.c[i] = a.c[i] + b.c[i];
        return result;
    }
    friend Polynomial operator-(const Polynomial& a, const Polynomial& b) {
        Polynomial result;
        result.degree = a.degree > b.degree ? a.degree : b.degree;
        const auto terms = static_cast<std::size_t>(result.degree) + 1;
        for (std::size_t i = 0; i < terms; ++i) result.c[i] = a.c[i] - b.c[i];
        return result;
    }
    /// The product; its degree must not pass max_degree.
    friend Polynomial operator*(const Polynomial& a, const Polynomial& b) {
        Polynomial p;
        p.degree = a.degree + b.degree;
        for (std::size_t i = 0; i <= static_cast<std::size_t>(a.degree); ++i)
            for (std::size_t j = 0; j <= static_cast<std::size_t>(b.degree); ++j)
                p.c.at(i + j) = p.c.at(i + j) + a.c[i] * b.c[j];
        return p;
    }
};
using Polynomial = PolynomialOf<quad>;

/// Up to four numbers, ascending.
struct Roots {
    std::array<quad, Polynomial::max_degree> values{};
    std::size_t count = 0;

    void add(quad x) { values.at(count++) = x; }
    const quad* begin() const { return values.data(); }
    const quad* end() const { return values.data() + count; }
};

namespace detail {

inline double evaluate(const std::array<double, 5>& c, int degree, double x) {
    double sum = c[static_cast<std::size_t>(degree)];
    for (int i = degree; i-- > 0;) sum = sum * x + c[static_cast<std::size_t>(i)];
    return sum;
}

/// A first guess in double at the one root in (low, high); `rising`: p(low) < 0 < p(high).
inline double guess(const Polynomial& p, double low, double high, bool rising) {
    std::array<double, 5> c{}, d{};
    for (std::size_t i = 0; i <= static_cast<std::size_t>(p.degree); ++i) c[i] = to_double(p.c[i]);
    for (std::size_t i = 1; i <= static_cast<std::size_t>(p.degree); ++i) d[i - 1] = static_cast<double>(i) * c[i];
    double x = 0.5 * (low + high);
    for (int i = 0; i < 80; ++i) {
        const double f = evaluate(c, p.degree, x);
        if (f == 0) return x;
        ((f < 0) == rising ? low : high) = x;
        double next = x - f / evaluate(d, p.degree > 0 ? p.degree - 1 : 0, x);
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (std::abs(next - x) <= 1e-16 * std::abs(x)) return next;
        x = next;
    }
    return x;
}

/// The one root of p in (low, high), where p(low) and p(high) differ in sign.
inline quad refine(const Polynomial& p, const Polynomial& derivative, quad low, quad high, bool rising) {
    const quad settled = (high - low) * quad(1e-33);
    quad x = guess(p, to_double(low), to_double(high), rising);
    if (!(x > low && x < high)) x = (low + high) / 2;
    for (int i = 0; i < 400; ++i) {
        const quad f = p(x);
        if (f == 0) return x;
        ((f < 0) == rising ? low : high) = x;
        if (high - low <= settled) break;
        const quad slope = derivative(x);
        quad next = slope == 0 ? low : x - f / slope;
        // Newton settles in a few steps from the guess; near a double root it creeps, and bisection is surer.
        if (!(next > low && next < high) || i > 12) next = (low + high) / 2;
        if (absolute(next - x) <= settled) return next;
        x = next;
    }
    return (low + high) / 2;
}

}  // namespace detail

/// All roots of p in [low, high], ascending. A double root counts once, and only if p is exactly 0 there or its
/// sign changes through rounding: where that matters the caller looks at p at the roots of its derivative.
inline Roots roots(const Polynomial& p, quad low, quad high) {
    Roots found;
    if (p.degree < 1) return found;
    if (p.degree == 1) {
        if (p.c[1] == 0) return found;
        const quad x = -p.c[0] / p.c[1];
        if (x >= low && x <= high) found.add(x);
        return found;
    }
    const Polynomial derivative = p.derivative();
    const Roots turns = roots(derivative, low, high);
    quad left = low, f_left = p(low);
    if (f_left == 0) found.add(left);
    const auto step = [&](quad right) {
        const quad f_right = p(right);
        if (f_right == 0) {
            if (found.count < static_cast<std::size_t>(p.degree)) found.add(right);
        } else if (f_left != 0 && (f_left < 0) != (f_right < 0) && found.count < static_cast<std::size_t>(p.degree)) {
            found.add(detail::refine(p, derivative, left, right, f_left < 0));
        }
        left = right;
        f_left = f_right;
    };
    for (const quad turn : turns)
        if (turn > left) step(turn);
    if (high > left) step(high);
    return found;
}

}  // namespace csgrt::oracle
