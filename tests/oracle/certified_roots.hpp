// Certified roots: all roots in an interval of a polynomial whose coefficients have error bounds, or the information
// that the bounds are too large to tell them apart.
//
// The interval is halved until on every part either |p| stays above a given bound or p' keeps its sign: what the
// Taylor series about a part's middle says for certain. A part of the latter kind has one root if p's signs at its
// ends differ, and none if they agree.
#pragma once

#include "polynomial.hpp"
#include "filter_numbers.hpp"

namespace csgrt::oracle {

struct CertifiedRoot {
    BoundedDouble at;
    double slope = 0;  ///< p' there
};

class CertifiedRoots {
public:
    /// In [low, high]. Where p turns and at both ends |p| must be above `least`, or nothing is certain.
    CertifiedRoots(const PolynomialOf<BoundedDouble>& p, double low, double high, double least) : p_(p), least_(least) {
        const BoundedDouble at_low = p(low), at_high = p(high);
        first_ = at_low.v;
        certain_ = at_low.least() > least && at_high.least() > least && part(low, high, at_low, at_high, 0);
    }

    bool certain() const { return certain_; }
    std::size_t count() const { return count_; }
    const CertifiedRoot& operator[](std::size_t i) const { return roots_[i]; }
    /// Is p negative before the first root?
    bool begins_inside() const { return first_ < 0; }

private:
    using Taylor = std::array<BoundedDouble, Polynomial::max_degree + 1>;

    Taylor taylor(double about) const {
        Taylor t = p_.c;
        const BoundedDouble x(about);
        for (int i = 0; i < p_.degree; ++i)
            for (int k = p_.degree - 1; k >= i; --k) {
                const auto at = static_cast<std::size_t>(k);
                t[at] = t[at] + x * t[at + 1];
            }
        return t;
    }
    /// By how much p (from = 0) or p' (from = 1) may change within `half` of where the series is taken, at most.
    double change(const Taylor& t, double half, int from) const {
        double sum = 0, power = half;
        for (int i = from + 1; i <= p_.degree; ++i, power *= half)
            sum += (from == 0 ? 1 : i) * t[static_cast<std::size_t>(i)].most() * power;
        return 1.000001 * sum;
    }

    bool part(double low, double high, const BoundedDouble& at_low, const BoundedDouble& at_high, int depth) {
        const double middle = 0.5 * (low + high), half = 0.5000001 * (high - low);
        const Taylor t = taylor(middle);
        if (t[0].least() > change(t, half, 0) + least_) return true;
        if (t[1].least() > change(t, half, 1)) {
            if ((at_low.v < 0) == (at_high.v < 0)) return true;
            return refine(low, high, at_low.v < 0);
        }
        if (depth == 26) return false;
        // Not in the middle, where what is symmetrical has its roots.
        const double cut = low + 0.4871 * (high - low);
        const BoundedDouble at_cut = p_(cut);
        if (!(at_cut.least() > 0)) return false;
        return part(low, cut, at_low, at_cut, depth + 1) && part(cut, high, at_cut, at_high, depth + 1);
    }

    double value(double x) const {
        double sum = p_.c[static_cast<std::size_t>(p_.degree)].v;
        for (int i = p_.degree; i-- > 0;) sum = sum * x + p_.c[static_cast<std::size_t>(i)].v;
        return sum;
    }
    double slope(double x) const {
        double sum = p_.degree * p_.c[static_cast<std::size_t>(p_.degree)].v;
        for (int i = p_.degree; i-- > 1;) sum = sum * x + i * p_.c[static_cast<std::size_t>(i)].v;
        return sum;
    }
    /// The one root between low and high. However it is found, the series about it says how far off it is.
    bool refine(double low, double high, bool rising) {
        const double from = low, to = high;
        double x = 0.5 * (low + high);
        for (int i = 0; i < 60; ++i) {
            const double f = value(x);
            if (f == 0) break;
            ((f < 0) == rising ? low : high) = x;
            double next = x - f / slope(x);
            if (!(next > low && next < high)) next = 0.5 * (low + high);
            const double step = std::abs(next - x);
            x = next;
            if (step <= 1e-16 * std::abs(x)) break;
        }
        const Taylor t = taylor(x);
        const double near = 1e-4 * (to - from), least = t[1].least() - change(t, near, 1);
        if (!(least > 0) || count_ == roots_.size()) return false;
        const double off = 1.000001 * t[0].most() / least;
        if (!(off < near)) return false;
        roots_[count_++] = {BoundedDouble(x, off), t[1].v};
        return t[1].error + change(t, off, 1) <= 1e-8 * std::abs(t[1].v);
    }

    const PolynomialOf<BoundedDouble>& p_;
    double least_, first_ = 0;
    std::array<CertifiedRoot, Polynomial::max_degree> roots_;
    std::size_t count_ = 0;
    bool certain_ = false;
};

}  // namespace csgrt::oracle
