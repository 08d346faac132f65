#include "ray_domain.hpp"

#include <algorithm>
#include <cmath>

namespace csgrt::bench {

double search_reach(const CompiledScene& scene) {
    double reach = 1.001 * scene.radius;
    if (scene.unbounded_count == 0) return reach;
    for (std::uint32_t i = 0; i < scene.unbounded_count; ++i) {
        const kernel::SolidRecord& record = scene.solids[i];
        for (std::uint32_t k = 0; k < record.plane_count; ++k) {
            const kernel::PlaneRecord& p = scene.planes[scene.words[record.first_plane + k] >> 1];
            const Vec3& c = scene.center;
            reach = std::max(reach, std::abs(p.nx * c.x + p.ny * c.y + p.nz * c.z - p.d));
        }
    }
    return 4 * (reach > 0 ? reach : 1);
}

Domain search_domain(const CompiledScene& scene, const Ray& ray) {
    const Vec3 &o = ray.origin, &d = ray.direction, &c = scene.center;
    const double speed = std::hypot(d.x, d.y, d.z);
    const double middle =
        ((c.x - o.x) * (d.x / speed) + (c.y - o.y) * (d.y / speed) + (c.z - o.z) * (d.z / speed)) / speed;
    const double half = search_reach(scene) / speed;
    return {middle - half, middle + half};
}

Domain in_box(const Box& box, const Ray& ray, const Domain& domain) {
    Domain d = domain;
    const auto clip = [&](double low, double high, double o, double rate) {
        if (!std::isfinite(low) || !std::isfinite(high)) return;
        if (rate == 0) {
            if (o < low || o > high) d.to = d.from;
            return;
        }
        const double a = (low - o) / rate, b = (high - o) / rate;
        d.from = std::max(d.from, std::min(a, b));
        d.to = std::min(d.to, std::max(a, b));
    };
    const double length = domain.to - domain.from;
    const Vec3& r = ray.direction;
    const double margin = 1e-9 * length * std::hypot(r.x, r.y, r.z);
    clip(box.low.x - margin, box.high.x + margin, ray.origin.x, r.x);
    clip(box.low.y - margin, box.high.y + margin, ray.origin.y, r.y);
    clip(box.low.z - margin, box.high.z + margin, ray.origin.z, r.z);
    d.from -= 1e-9 * length;
    d.to += 1e-9 * length;
    return {std::max(d.from, domain.from), std::min(d.to, domain.to)};
}

}  // namespace csgrt::bench
