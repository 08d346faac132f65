#include "reference/intersect.hpp"

#include "kernel_geometry.hpp"

namespace csgrt {
namespace {

kernel::Geometry tables(const CompiledScene& scene) {
    return {scene.solids.data(), scene.reals.data(), scene.planes.data(), scene.plane_refs.data()};
}
kernel::ray3 to_kernel(const Ray& r) {
    return {{r.origin.x, r.origin.y, r.origin.z}, {r.direction.x, r.direction.y, r.direction.z}};
}

}  // namespace

std::vector<SolidSegment> intersect_solid(const CompiledScene& scene, std::uint32_t solid, const Ray& ray) {
    const kernel::Geometry g = tables(scene);
    const kernel::ray3 r = to_kernel(ray);
    const kernel::SolidRecord& record = scene.solids[solid];
    const kernel::hits h = kernel::intersect(g, record, r);
    std::vector<SolidSegment> segments;
    const auto add = [&](double in, std::uint32_t in_surface, double out, std::uint32_t out_surface) {
        const kernel::vec3 a = kernel::normal_at(g, record, r, in, in_surface);
        const kernel::vec3 b = kernel::normal_at(g, record, r, out, out_surface);
        segments.push_back({in, out, {a.x, a.y, a.z}, {b.x, b.y, b.z}});
    };
    if (h.count > 0) add(h.in0, h.in0_surface, h.out0, h.out0_surface);
    if (h.count > 1) add(h.in1, h.in1_surface, h.out1, h.out1_surface);
    return segments;
}

void collect_ends(const CompiledScene& scene, const Ray& ray, double t_min, std::vector<kernel::End>& ends) {
    const kernel::Geometry g = tables(scene);
    const kernel::ray3 r = to_kernel(ray);
    ends.clear();
    for (std::uint32_t solid = 0; solid < scene.solids.size(); ++solid) {
        const kernel::hits h = kernel::intersect(g, scene.solids[solid], r);
        if (h.count > 0 && h.out0 >= t_min) {
            ends.push_back({h.in0, solid, h.in0_surface});
            ends.push_back({h.out0, solid, h.out0_surface});
        }
        if (h.count > 1 && h.out1 >= t_min) {
            ends.push_back({h.in1, solid, h.in1_surface});
            ends.push_back({h.out1, solid, h.out1_surface});
        }
    }
}

}  // namespace csgrt
