// A function that is no polynomial, restricted to a ray: its extrema, and where it has a given value.
//
// The solid says where the function may be uneven (`breaks`: kinks, cusps) and how many pieces each part between two
// breaks is looked at in. Sign changes of the slope, sampled closely towards the breaks, are halved down; between two
// neighbouring turns the function is monotone, so signs at the turns decide about its roots, as in polynomial.hpp.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "quad.hpp"

namespace csgrt::oracle {

class RayFunction {
public:
    virtual ~RayFunction() = default;
    virtual quad operator()(quad s) const = 0;
    virtual quad slope(quad s) const = 0;
    /// Where the function is equal to `level` in [low, high], ascending.
    virtual std::vector<quad> crossings(quad level, quad low, quad high) const = 0;
    /// Where it may turn in [low, high].
    virtual std::vector<quad> turns(quad low, quad high) const = 0;
    /// The function is looked at more closely around these points, too.
    virtual void look_at(const std::vector<quad>& points) = 0;
};

/// F: `quad value(const QVec&)`, `QVec gradient(const QVec&)`, `std::vector<quad> breaks(const QVec& o, const QVec&
/// d)`, `int pieces()` (1: convex), `double settled()`: to what part of the ray's length a root is found.
template <class F>
class RayFunctionOf final : public RayFunction {
public:
    RayFunctionOf(const F& f, const QVec& o, const QVec& d) : f_(f), o_(o), d_(d) {}

    quad operator()(quad s) const override { return f_.value(o_ + s * d_); }
    quad slope(quad s) const override { return dot(f_.gradient(o_ + s * d_), d_); }

    std::vector<quad> turns(quad low, quad high) const override {
        if (low == low_ && high == high_) return turns_;
        low_ = low;
        high_ = high;
        turns_.clear();
        std::vector<quad> ends{low};
        for (const std::vector<quad>& points : {f_.breaks(o_, d_), points_})
            for (const quad s : points)
                if (s > low && s < high) ends.push_back(s);
        ends.push_back(high);
        std::sort(ends.begin(), ends.end());
        for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
            if (i > 0) turns_.push_back(ends[i]);
            part(ends[i], ends[i + 1]);
        }
        return turns_;
    }

    std::vector<quad> crossings(quad level, quad low, quad high) const override {
        std::vector<quad> knots = turns(low, high), found;
        knots.insert(knots.begin(), low);
        knots.push_back(high);
        for (std::size_t i = 0; i < knots.size(); ++i) {
            const quad a = (*this)(knots[i]) - level;
            if (a == 0) found.push_back(knots[i]);
            if (a == 0 || i + 1 == knots.size()) continue;
            const quad b = (*this)(knots[i + 1]) - level;
            if (b != 0 && (a < 0) != (b < 0)) found.push_back(between(level, knots[i], knots[i + 1], a < 0));
        }
        return found;
    }

    void look_at(const std::vector<quad>& points) override {
        points_ = points;
        low_ = 1, high_ = 0;
    }

private:
    /// Turns strictly between two breaks. Samples gather towards both, down to a 10^12th of the way.
    void part(quad from, quad to) const {
        std::vector<quad> samples;
        const quad middle = (from + to) / 2, half = (to - from) / 2;
        if (f_.pieces() > 1)
            for (quad near = quad(1e-12); near < quad(0.05); near *= 2) samples.push_back(from + near * half);
        for (int i = 1; i < f_.pieces(); ++i) samples.push_back(from + quad(2 * i) / f_.pieces() * half);
        if (f_.pieces() > 1) {
            for (quad near = quad(1e-12); near < quad(0.05); near *= 2) samples.push_back(to - near * half);
        } else {
            samples = {from, middle, to};
        }
        std::sort(samples.begin(), samples.end());
        std::vector<quad> slopes;
        for (const quad s : samples) slopes.push_back(slope(s));
        const auto same = [&](std::size_t i, std::size_t k) { return (slopes[i] < 0) == (slopes[k] < 0); };
        for (std::size_t i = 0; i < samples.size(); ++i) {
            if (i > 0 && !same(i - 1, i)) turns_.push_back(turn(samples[i - 1], samples[i], slopes[i - 1] < 0));
            // Least among its neighbours of the same sign: it may be 0 twice beside it.
            const bool left = i > 0 && same(i - 1, i), right = i + 1 < samples.size() && same(i, i + 1);
            const bool least = (!left || absolute(slopes[i]) <= absolute(slopes[i - 1])) &&
                               (!right || absolute(slopes[i]) <= absolute(slopes[i + 1]));
            if (least && (left || right)) dip(samples[left ? i - 1 : i], samples[right ? i + 1 : i]);
        }
        std::sort(turns_.begin(), turns_.end());
    }
    /// The slope comes near to 0 between a and b and may pass it twice.
    void dip(quad a, quad b) const {
        const quad from = a, to = b;
        const bool falling = slope(a) < 0;
        for (int i = 0; i < 60; ++i) {
            const quad left = (2 * a + b) / 3, right = (a + 2 * b) / 3, f = slope(left), g = slope(right);
            if ((f < 0) != falling || (g < 0) != falling) {
                const quad passed = (f < 0) != falling ? left : right;
                turns_.push_back(turn(from, passed, falling));
                turns_.push_back(turn(passed, to, !falling));
                return;
            }
            (absolute(f) < absolute(g) ? b : a) = absolute(f) < absolute(g) ? right : left;
        }
    }
    quad turn(quad a, quad b, bool falling) const {
        for (int i = 0; i < 64; ++i) {
            const quad s = (a + b) / 2;
            ((slope(s) < 0) == falling ? a : b) = s;
        }
        return (a + b) / 2;
    }
    /// The root of f - level between a and b, where it is monotone: Newton's method kept inside the bracket.
    quad between(quad level, quad a, quad b, bool rising) const {
        const quad settled = quad(f_.settled()) * larger(absolute(low_), absolute(high_));
        quad s = (a + b) / 2, width = b - a;
        for (int i = 0; i < 300; ++i) {
            const quad f = (*this)(s)-level;
            ((f < 0) == rising ? a : b) = s;
            if (b - a <= settled) break;
            const quad rate = slope(s);
            quad next = rate == 0 ? a : s - f / rate;
            // Every third step halves, so that a slow approach from one side ends.
            if (!(next > a && next < b) || (i % 3 == 2 && b - a > width / 2)) next = (a + b) / 2;
            if (i % 3 == 2) width = b - a;
            if (absolute(next - s) <= settled / 4) return next;
            s = next;
        }
        return (a + b) / 2;
    }

    const F& f_;
    QVec o_, d_;
    std::vector<quad> points_;
    mutable quad low_ = 1, high_ = 0;
    mutable std::vector<quad> turns_;
};

}  // namespace csgrt::oracle
