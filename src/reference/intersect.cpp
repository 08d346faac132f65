#include "reference/intersect.hpp"

#include <limits>

#include "compile/tables.hpp"

namespace csgrt {
namespace {

kernel::ray3 to_kernel(const Ray& r) {
    return {{r.origin.x, r.origin.y, r.origin.z}, {r.direction.x, r.direction.y, r.direction.z}};
}

/// Appends the boundaries of one solid's segments.
void append_boundaries(const kernel::Geometry& g, std::uint32_t solid, const kernel::ray3& r, double t_min,
                       std::vector<kernel::Boundary>& boundaries) {
    const kernel::SolidRecord& record = g.solids[solid];
    const std::uint32_t segments = kernel::collect(g, record, solid, r, t_min, nullptr);
    if (segments == 0) return;
    const std::size_t first = boundaries.size();
    boundaries.resize(first + 2 * std::size_t{segments});
    kernel::collect(g, record, solid, r, t_min, boundaries.data() + first);
}

}  // namespace

std::vector<SolidSegment> intersect_solid(const CompiledScene& scene, std::uint32_t solid, const Ray& ray,
                                          Quartic quartic) {
    const kernel::ray3 r = to_kernel(ray);
    std::vector<kernel::Boundary> boundaries;
    append_boundaries(tables(scene, quartic), solid, r, -std::numeric_limits<double>::infinity(), boundaries);
    const auto normal = [&](const kernel::Boundary& end) {
        const kernel::vec3 n = kernel::normal_at(tables(scene), scene.solids[solid], r, end.t, end.surface);
        return Vec3{n.x, n.y, n.z};
    };
    std::vector<SolidSegment> segments;
    for (std::size_t i = 0; i < boundaries.size(); i += 2) {
        const kernel::Boundary &in = boundaries[i], &out = boundaries[i + 1];
        // For a ray in a face, the segments on the two sides of the face are found (kernels/geometry/beside.h).
        if ((in.surface & MISSED) && !(in.t < out.t)) continue;  // unused memory
        if ((in.surface & MISSED) && !segments.empty() && in.t <= segments.back().out) {
            if (out.t > segments.back().out) {
                segments.back().out = out.t;
                segments.back().out_normal = normal(out);
            }
            continue;
        }
        segments.push_back({in.t, out.t, normal(in), normal(out)});
    }
    return segments;
}

}  // namespace csgrt
