// Boxes of hearts and metaballs, whose extent has no closed form.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <queue>
#include <vector>

#include "compile/solids/curved_frames.hpp"
#include "compile/bounds/support_box.hpp"
#include "compile/bounds/tight_box.hpp"

namespace csgrt {

namespace {

/// Points of a quarter of the heart's surface, x and y not negative, around its centre. The surface is t(direction),
/// because (a t^2 - 1) / t^(5/3) grows with t. The points are so close that none of the surface lies more than `sparse`
/// outside their hull.
const std::vector<Wide>& heart_points() {
    constexpr long double pi = 3.14159265358979323846L;
    constexpr int around = 64, upward = 256;
    static const auto& points = *new const std::vector<Wide>([] {  // never destroyed: threads may outlive exit()
        std::vector<Wide> all;
        for (int i = 0; i <= around; ++i)
            for (int k = 0; k <= upward; ++k) {
                const long double phi = 0.5L * pi * i / around, height = pi * (1.0L * k / upward - 0.5L);
                const Wide d(std::cos(height) * std::cos(phi), std::cos(height) * std::sin(phi), std::sin(height));
                const long double a = d.x * d.x + 2.25L * d.y * d.y + d.z * d.z,
                                  b = d.z * std::cbrt(d.x * d.x + 0.1125L * d.y * d.y);
                long double low = 0, high = 2;
                for (int step = 0; step < 50; ++step) {
                    const long double t = 0.5L * (low + high);
                    (a * t * t - 1 < b * std::cbrt(t) * std::cbrt(t) * t ? low : high) = t;
                }
                all.push_back(high * d);
            }
        return all;
    }());
    return points;
}
constexpr long double sparse = 5e-4L;

/// Numbers of points.
using Points = std::vector<std::uint32_t>;

/// A cube within -1 to 1, its extent in the wanted direction, and a list that holds the points whose fields are not 0
/// in it.
struct Cube {
    Wide center;
    long double half, reach;
    std::shared_ptr<const Points> near;
    bool operator<(const Cube& other) const { return reach < other.reach; }
};

/// The extent of a metaball in direction n. The search cuts cubes into eight, the farthest cube first, and drops cubes
/// in which the fields cannot add up to the threshold. It ends when the farthest cube is small.
class FieldSupport {
public:
    explicit FieldSupport(const Metaball& s) : s_(s), frame_(frame_of(s)) {
        Points all;
        for (const Metaball::Point& p : s.points) {
            all.push_back(static_cast<std::uint32_t>(all.size()));
            points_.push_back((wide(p.position) - frame_.center) / frame_.reach);
            reaches_.push_back(field_radius(s, p) / frame_.reach);
        }
        all_ = std::make_shared<const Points>(std::move(all));
    }

    long double operator()(long double x, long double y, long double z) const {
        const Wide n(x, y, z);
        const long double width = std::fabs(x) + std::fabs(y) + std::fabs(z);
        constexpr long double smallest = 1.0L / 4096;
        std::size_t tests = 0;  // points tested against a cube
        std::priority_queue<Cube> cubes;
        cubes.push({Wide(0), 1, width, all_});
        while (!cubes.empty()) {
            const Cube cube = cubes.top();
            if (cube.half < smallest || tests > most_tests) return cube.reach;
            cubes.pop();
            const std::shared_ptr<const Points> near = near_to(cube);
            tests += cube.near->size() + 8 * near->size();
            for (int corner = 0; corner < 8; ++corner) {
                const long double half = 0.5L * cube.half;
                const Wide at =
                    cube.center + half * Wide(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
                if (may_hold(at, half, *near)) cubes.push({at, half, glm::dot(n, at) + half * width, near});
            }
        }
        return 0;  // the fields add up to the threshold nowhere
    }

private:
    static constexpr std::size_t most_tests = 2'000'000;

    /// The square of the distance of a point from a cube.
    long double away2(std::uint32_t point, const Wide& at, long double half) const {
        const Wide away = glm::max(glm::abs(at - points_[point]) - Wide(half), Wide(0));
        return glm::dot(away, away);
    }

    std::shared_ptr<const Points> near_to(const Cube& cube) const {
        Points near;
        for (const std::uint32_t i : *cube.near)
            if (away2(i, cube.center, cube.half) < reaches_[i] * reaches_[i]) near.push_back(i);
        return near.size() == cube.near->size() ? cube.near : std::make_shared<const Points>(std::move(near));
    }

    bool may_hold(const Wide& at, long double half, const Points& near) const {
        long double sum = 0;
        for (const std::uint32_t i : near) {
            sum += field(s_, s_.points[i], away2(i, at, half) * frame_.reach * frame_.reach);
            if (sum >= s_.threshold) return true;
        }
        return false;
    }

    const Metaball& s_;
    MetaballFrame frame_;
    std::vector<Wide> points_;
    std::vector<long double> reaches_;
    std::shared_ptr<const Points> all_;
};

}  // namespace

Box Tight::operator()(const Hrt& s) const {
    return support_box(m, wide(s.v), {wide(s.x), wide(s.y), wide(s.z)},
                       [](long double x, long double y, long double z) {
                           const Wide n(std::fabs(x), std::fabs(y), z);
                           long double most = 0;
                           for (const Wide& p : heart_points()) most = std::max(most, glm::dot(n, p));
                           return most + sparse * glm::length(n);
                       });
}

Box Tight::operator()(const Metaball& s) const {
    const MetaballFrame frame = frame_of(s);
    return support_box(m, frame.center, WideMatrix(frame.reach), FieldSupport(s));
}

}  // namespace csgrt
