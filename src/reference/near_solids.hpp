// Which solids the reference tries on a ray: all that come near it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// A sphere around each solid, half as large again as the one around its box. The reference is there to find what is
/// wrong, also with boxes: one that is too small by less than a third keeps no solid from being tried, so what it hides
/// from the pipeline is seen. An unbounded solid is near every ray.
class NearSolids {
public:
    explicit NearSolids(const CompiledScene& scene);

    /// Calls call(solid) in ascending order, for the whole line of the ray.
    template <class Call>
    void for_each(const Ray& ray, const Call& call) const {
        Vec3 d = ray.direction;  // of any length: scaled, so that no square of it overflows or vanishes
        const double longest = std::fmax(std::fabs(d.x), std::fmax(std::fabs(d.y), std::fabs(d.z)));
        d = {d.x / longest, d.y / longest, d.z / longest};
        for (std::size_t group = 0; group < groups_.size(); ++group) {
            const std::array<double, size> room = room_in(groups_[group], ray.origin, d);
            const std::size_t end = std::min(size, count_ - group * size);
            for (std::size_t i = 0; i < end; ++i)
                if (!(room[i] < 0)) call(static_cast<std::uint32_t>(group * size + i));  // what overflowed is no number
        }
    }

private:
    static constexpr std::size_t size = 8;
    struct Spheres {
        std::array<double, size> x, y, z, radius2;
    };

    /// Below zero where the line passes by: the radius' square less that of the distance, times the direction's. A loop
    /// that compilers turn into vectors.
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
