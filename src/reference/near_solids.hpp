// Near solids: the solids with which the reference intersects a ray.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// A sphere around each solid. Its radius is 1.5 times the radius of the sphere around the solid's box, because the
/// reference has to find faults of boxes, too: a solid whose box is too small by less than a third is still tried,
/// though the pipeline misses it. An unbounded solid is near every ray.
class NearSolids {
public:
    explicit NearSolids(const CompiledScene& scene);

    /// Calls call(solid) in ascending order, for the whole line of the ray.
    template <class Call>
    void for_each(const Ray& ray, const Call& call) const {
        Vec3 d = ray.direction;  // scaled below, so that no square overflows or vanishes
        const double longest = std::fmax(std::fabs(d.x), std::fmax(std::fabs(d.y), std::fabs(d.z)));
        d = {d.x / longest, d.y / longest, d.z / longest};
        for (std::size_t group = 0; group < groups_.size(); ++group) {
            const std::array<double, size> room = room_in(groups_[group], ray.origin, d);
            const std::size_t end = std::min(size, count_ - group * size);
            for (std::size_t i = 0; i < end; ++i)
                if (!(room[i] < 0)) call(static_cast<std::uint32_t>(group * size + i));  // an overflow makes a NaN
        }
    }

private:
    static constexpr std::size_t size = 8;
    struct Spheres {
        std::array<double, size> x, y, z, radius2;
    };

    /// The square of the radius minus the square of the line's distance, times the square of the direction's length. It
    /// is below zero if the line misses the sphere. Compilers vectorize the loop.
    static std::array<double, size> room_in(const Spheres& s, const Vec3& o, const Vec3& d) {
        const double size2 = d.x * d.x + d.y * d.y + d.z * d.z;
        std::array<double, size> room;
        for (std::size_t i = 0; i < size; ++i) {
            const double x = s.x[i] - o.x, y = s.y[i] - o.y, z = s.z[i] - o.z;
            const double a = y * d.z - z * d.y, b = z * d.x - x * d.z, c = x * d.y - y * d.x;
            const double rounding = 1e-24 * (x * x + y * y + z * z);
            room[i] = (s.radius2[i] + rounding) * size2 - (a * a + b * b + c * c);
        }
        return room;
    }

    std::size_t count_;
    std::vector<Spheres> groups_;
};

}  // namespace csgrt
