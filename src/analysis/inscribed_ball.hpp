// Inscribed ball: the largest ball between planes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/vector.hpp"

namespace csgrt::analysis {

struct Ball {
    Vec3 center = {};
    double radius = 0;  ///< mm; 0: there is no ball
};

/// A plane that touches a body: a point and the unit vector away from the body.
struct TangentPlane {
    Vec3 point = {}, normal = {};
    bool is_near = true;   ///< no other part of the boundary takes its place near the point that it was made for
    bool is_sure = false;  ///< the body near that point lies behind it

    double distance(const Vec3& from) const { return dot(normal, point - from); }
};

inline double nearest(const std::vector<TangentPlane>& planes, const Vec3& from) {
    double least = std::numeric_limits<double>::infinity();
    for (const TangentPlane& plane : planes) least = std::min(least, plane.distance(from));
    return least;
}

/// The planes that the point is in front of: the nearest point of the plane is near the point where it touches. Others
/// tell nothing of the boundary near by, if this is concave.
inline std::vector<TangentPlane> faced(std::vector<TangentPlane> planes, const Vec3& point) {
    std::erase_if(planes, [&](const TangentPlane& p) { return p.distance(point) < 0.5 * length(p.point - point); });
    return planes;
}

/// Moves a point between planes to where the nearest plane is as far as possible, but no farther than `reach`. The
/// least distance is replaced by a smooth one, -log(sum of exp(-b distance)) / b, whose maximum Newton's steps find,
/// for one b after the other; with b the smooth distance approaches the least one.
inline Vec3 between(const std::vector<TangentPlane>& planes, const Vec3& start, double reach) {
    Vec3 x = start;
    const double scale = nearest(planes, start);
    if (!(scale > 0) || !std::isfinite(scale)) return x;
    const auto smooth = [&](const Vec3& at, double b) {
        const double least = nearest(planes, at);
        double sum = 0;
        for (const TangentPlane& plane : planes) sum += std::exp(-b * (plane.distance(at) - least));
        return least - std::log(sum) / b;
    };
    for (const double sharpness : {2.0, 8.0, 32.0, 128.0, 512.0}) {
        const double b = sharpness / std::max(nearest(planes, x), scale);
        for (int step = 0; step < 8; ++step) {
            const double least = nearest(planes, x);
            double sum = 0;
            Vec3 mean = {};
            std::array<double, 6> second = {};  // xx, yy, zz, xy, yz, zx
            for (const TangentPlane& plane : planes) {
                const double w = std::exp(-b * (plane.distance(x) - least));
                const Vec3& n = plane.normal;
                sum += w;
                mean = mean + w * n;
                const double products[] = {n.x * n.x, n.y * n.y, n.z * n.z, n.x * n.y, n.y * n.z, n.z * n.x};
                for (std::size_t i = 0; i < 6; ++i) second[i] += w * products[i];
            }
            mean = 1 / sum * mean;
            constexpr double damping = 1e-3;
            const double xx = second[0] / sum - mean.x * mean.x + damping,
                         yy = second[1] / sum - mean.y * mean.y + damping,
                         zz = second[2] / sum - mean.z * mean.z + damping, xy = second[3] / sum - mean.x * mean.y,
                         yz = second[4] / sum - mean.y * mean.z, zx = second[5] / sum - mean.z * mean.x;
            const Vec3 a = {xx, xy, zx}, c = {xy, yy, yz}, d = {zx, yz, zz};
            const double det = dot(a, cross(c, d));
            Vec3 by = 1 / (det * b) * Vec3{dot(mean, cross(c, d)), dot(a, cross(mean, d)), dot(a, cross(c, mean))};
            by = -1.0 * by;
            if (const double size = length(by); size > least) by = least / size * by;
            const double now = smooth(x, b);
            double part = 1;
            while (part > 1e-3 && !(smooth(x + part * by, b) > now)) part *= 0.5;
            if (part <= 1e-3) break;
            x = x + part * by;
            if (const double far = length(x - start); far > reach) x = start + reach / far * (x - start);
        }
    }
    return x;
}

/// Climb's next point, from a point. All planes lead to the middle of a convex body, the ones that it is in front
/// of, `near`, along a curved one.
inline Vec3 climbed(const std::vector<TangentPlane>& planes, const std::vector<TangentPlane>& near, const Vec3& from,
                    double reach, bool by_all) {
    return between(by_all || near.size() < 4 ? planes : near, from, reach);
}

}  // namespace csgrt::analysis
