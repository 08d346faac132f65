#include "scene/solids/sketch_extent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace csgrt {

namespace {

constexpr long double precision = 1e-16L;
constexpr int deepest = 60;  // halvings; 30 bring the control points of a smooth curve within `precision` of the curve

/// A curve's control points along the direction, in homogeneous coordinates.
struct Values {
    std::vector<long double> value, weight;

    long double at(std::size_t i) const { return value[i] / weight[i]; }
    long double greatest() const {
        long double most = at(0);
        for (std::size_t i = 1; i < value.size(); ++i) most = std::max(most, at(i));
        return most;
    }
    std::pair<Values, Values> halves() const {
        Values left = *this, right = *this;
        for (std::vector<long double> Values::*part : {&Values::value, &Values::weight}) {
            std::vector<long double>&l = left.*part, &r = right.*part;
            const std::size_t last = r.size() - 1;
            for (std::size_t round = 1; round <= last; ++round) {
                for (std::size_t i = 0; i + round <= last; ++i) r[i] = (r[i] + r[i + 1]) / 2;
                l[round] = r[0];
            }
        }
        return {left, right};
    }
};

/// Raises `most` to the curve's greatest value, by halving the curve: no value is above the control points' greatest
/// one, and the values at both ends are reached.
void raise(long double& most, const Values& curve, long double slack, int depth) {
    most = std::max({most, curve.at(0), curve.at(curve.value.size() - 1)});
    if (curve.greatest() <= most + slack || depth == deepest) return;
    const auto [left, right] = curve.halves();
    raise(most, left, slack, depth + 1);
    raise(most, right, slack, depth + 1);
}

long double greatest(const std::vector<BezierCurve>& curves, long double gu, long double gv) {
    long double most = -std::numeric_limits<long double>::infinity(), size = 0;
    for (const BezierCurve& curve : curves)
        for (const CurvePoint& p : curve) size = std::max({size, std::fabs(gu * p.u), std::fabs(gv * p.v)});
    for (const BezierCurve& curve : curves)
        for (const std::size_t end : {std::size_t{0}, curve.size() - 1})
            most = std::max(most, gu * curve[end].u + gv * curve[end].v);
    for (const BezierCurve& curve : curves) {
        Values values;
        for (const CurvePoint& p : curve) {
            values.value.push_back((gu * p.u + gv * p.v) * p.weight);
            values.weight.push_back(p.weight);
        }
        raise(most, values, precision * size, 0);
    }
    return most + precision * size;
}

}  // namespace

std::pair<long double, long double> extent_of(const std::vector<BezierCurve>& curves, long double gu, long double gv) {
    return {-greatest(curves, -gu, -gv), greatest(curves, gu, gv)};
}

}  // namespace csgrt
