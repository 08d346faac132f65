// The same scene in other words: every change of scene and rays that must leave the regions as they are.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "integration/stress/sequence.hpp"
#include "stress/rewrite.hpp"

namespace csgrt::test {

struct Change {
    const char* name;
    bool to_the_bit;  ///< not a bit may change. (Commuted, another of two equal surfaces may come first.)
};
inline constexpr std::array<Change, 10> changes{{
    {"A-B", true},  // as A and not B
    {"De Morgan", true},
    {"not not", true},
    {"commuted", false},
    {"reversed", false},  // rays from their other ends
    {"translated", false},
    {"turned 90", false},
    {"turned", false},
    {"x 8", false},
    {"/ 1024", false},
}};

namespace detail {

inline Vec3 point(const Matrix& m, const Vec3& p, bool direction) {
    const auto row = [&](std::size_t i) {
        const long double d = static_cast<long double>(m[i]) * p.x + static_cast<long double>(m[i + 1]) * p.y +
                              static_cast<long double>(m[i + 2]) * p.z;
        return static_cast<double>(direction ? d : d + static_cast<long double>(m[i + 3]));
    };
    return {row(0), row(4), row(8)};
}

}  // namespace detail

/// A changed scene with its rays.
struct Changed {
    Scene scene;
    std::vector<std::string> objects;
    std::vector<Ray> rays;
    std::vector<double> way;  ///< reversed: the length of each ray, from whose end it comes back; else empty
};

/// `size`: of the scene, millimetres. `found`: what the rays met, to know where they can come back from.
inline Changed changed(const stress::StressScene& from, std::size_t change, double size,
                       const std::vector<Sequence>& found) {
    using stress::Rewriting;
    Changed result{from.scene, from.objects, from.rays, {}};
    const auto by = [&](const Matrix& m) {
        result.scene = stress::moved(from.scene, from.objects, m);
        result.objects = {"moved"};
        for (Ray& ray : result.rays) ray = {detail::point(m, ray.origin, false), detail::point(m, ray.direction, true)};
    };
    const double unit = std::ldexp(1.0, std::ilogb(size));
    switch (change) {
        case 0:
            result.scene = stress::rewritten(from.scene, Rewriting::differences);
            break;
        case 1:
            result.scene = stress::rewritten(from.scene, Rewriting::de_morgan);
            break;
        case 2:
            result.scene = stress::rewritten(from.scene, Rewriting::double_complements);
            break;
        case 3:
            result.scene = stress::rewritten(from.scene, Rewriting::commuted);
            break;
        case 4:
            for (std::size_t i = 0; i < result.rays.size(); ++i) {
                Ray& ray = result.rays[i];
                const double speed = std::hypot(ray.direction.x, ray.direction.y, ray.direction.z);
                const double end = found[i].empty() ? 0 : found[i].back().out;
                const double way = std::ldexp(1.0, std::ilogb(end + size / speed) + 1);
                result.way.push_back(way);
                ray.origin = {ray.origin.x + way * ray.direction.x, ray.origin.y + way * ray.direction.y,
                              ray.origin.z + way * ray.direction.z};
                ray.direction = {-ray.direction.x, -ray.direction.y, -ray.direction.z};
            }
            break;
        case 5:
            by({1, 0, 0, unit, 0, 1, 0, -2 * unit, 0, 0, 1, 0.5 * unit, 0, 0, 0, 1});
            break;
        case 6:
            by({0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
            break;
        case 7:  // the quaternion (3, 1, 2, -1) / sqrt 15
            by({1.0 / 3, 2.0 / 3, 2.0 / 3, 0, -2.0 / 15, 11.0 / 15, -2.0 / 3, 0, -14.0 / 15, 2.0 / 15, 1.0 / 3, 0, 0, 0,
                0, 1});
            break;
        case 8:
            by({8, 0, 0, 0, 0, 8, 0, 0, 0, 0, 8, 0, 0, 0, 0, 1});
            break;
        default: {
            const double s = 0x1p-10;
            by({s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, 0, 0, 0, 1});
            break;
        }
    }
    return result;
}

/// What a ray that comes back met, as its original must have met it.
inline Sequence turned_around(const Sequence& back, double way) {
    Sequence sequence;
    for (auto item = back.rbegin(); item != back.rend(); ++item)
        sequence.push_back({item->region, way - item->out, way - item->in, item->out_tolerance, item->in_tolerance});
    const auto ahead =
        std::find_if(sequence.begin(), sequence.end(), [](const Item& i) { return i.out > 0 && i.region != nothing; });
    sequence.erase(sequence.begin(), ahead);
    return sequence;
}

}  // namespace csgrt::test
