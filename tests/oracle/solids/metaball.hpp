// Metaball: where the fields of its points add up to the threshold or more.
// With r the distance to a point of strength s and softness w: (1 - (r/s)^2)^2
// within r < s, s^2 / r^2, or exp(w - w (r/s)^2). The function is 1 - sum /
// threshold, or threshold / sum - 1 where the sum may be infinite.
#pragma once

#include "../solid.hpp"

namespace csgrt::oracle {

struct MetaballFunction {
    Metaball::Method method;
    quad threshold;
    struct Point {
        QVec at;
        quad s, w;
    };
    std::vector<Point> points;

    quad terms() const { return 1; }
    double settled() const { return method == Metaball::Method::blob ? 1e-18 : 1e-28; }
    int pieces() const { return 64 + 24 * static_cast<int>(points.size()); }
    std::vector<quad> breaks(const QVec&, const QVec&) const { return {}; }

    /// The field and its derivative by the square of the distance.
    std::pair<quad, quad> field(const Point& p, quad v) const {
        const quad s2 = p.s * p.s;
        switch (method) {
            case Metaball::Method::isopotential:
                return {s2 / v, -s2 / (v * v)};
            case Metaball::Method::blob: {
                const quad e = std::exp(static_cast<long double>(p.w - p.w * v / s2));
                return {e, -p.w / s2 * e};
            }
            default: {
                const quad rest = larger(0, 1 - v / s2);
                return {rest * rest, -2 * rest / s2};
            }
        }
    }
    quad value(const QVec& p) const {
        quad sum = 0;
        for (const Point& point : points) {
            const QVec from = p - point.at;
            const quad v = dot(from, from);
            if (method == Metaball::Method::isopotential && v == 0) return -1;
            sum += field(point, v).first;
        }
        return method == Metaball::Method::isopotential ? threshold / sum - 1 : 1 - sum / threshold;
    }
    QVec gradient(const QVec& p) const {
        quad sum = 0;
        QVec slope;
        for (const Point& point : points) {
            const QVec from = p - point.at;
            const quad v = dot(from, from);
            if (method == Metaball::Method::isopotential && v == 0) return {};
            const auto [value, rate] = field(point, v);
            sum += value;
            slope = slope + 2 * rate * from;
        }
        return (method == Metaball::Method::isopotential ? -threshold / (sum * sum) : -1 / threshold) * slope;
    }
};

/// In a frame of its own, and that frame.
inline std::pair<MetaballFunction, QAffine> metaball_function(const Metaball& s) {
    const quad count = static_cast<double>(s.points.size());
    QVec middle;
    for (const Metaball::Point& p : s.points) middle = middle + (1 / count) * QVec(p.position);
    // On the surface one point at least makes its share of the threshold.
    const quad share = s.threshold / count;
    quad reach = 0;
    for (const Metaball::Point& p : s.points) {
        quad r = p.strength;
        if (s.method == Metaball::Method::isopotential) r = r / root(share);
        if (s.method == Metaball::Method::blob)
            r = r * root(larger(0, 1 - quad(std::log(to_double(share))) / p.softness));
        reach = larger(reach, length(QVec(p.position) - middle) + r);
    }
    MetaballFunction f{s.method, s.threshold, {}};
    for (const Metaball::Point& p : s.points)
        f.points.push_back({(1 / reach) * (QVec(p.position) - middle), p.strength / reach, p.softness});
    return {f, {{reach, 0, 0}, {0, reach, 0}, {0, 0, reach}, middle}};
}

inline ImplicitSolid implicit(const Metaball& s, const QAffine& place) {
    ImplicitSolid solid;
    const auto [f, frame] = metaball_function(s);
    add_frame(solid, place, frame);
    solid.add_curved(f);
    const QAffine& w = solid.to_world;
    solid.radius = to_double(root(dot(w.x, w.x) + dot(w.y, w.y) + dot(w.z, w.z)));
    solid.size = solid.radius;
    return solid;
}

}  // namespace csgrt::oracle
