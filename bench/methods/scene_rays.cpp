#include "scene_rays.hpp"

#include <algorithm>

#include "compile/linear.hpp"
#include "compile/tables.hpp"
#include "rays/frame.hpp"

namespace csgrt::bench {
namespace {

kernel::ray3 to_kernel(const Ray& ray) {
    return {{ray.origin.x, ray.origin.y, ray.origin.z}, {ray.direction.x, ray.direction.y, ray.direction.z}};
}

}  // namespace

double tolerance_of(const CompiledScene& scene) {
    if (scene.tolerance > 0) return scene.tolerance;
    return std::max(rounding_tolerance(Precision::double_) * 2 * scene.radius,
                    coordinate_rounding * largest_coordinate(scene.center, scene.radius));
}

SceneRays::SceneRays(const CompiledScene& scene)
    : scene_(scene), geometry_(tables(scene)), frame_(prepare_rays(scene, 1, tolerance_of(scene)).frame) {}

void SceneRays::candidates(const Ray& ray, double t_min, std::vector<std::uint32_t>& solids) const {
    solids.clear();
    for (std::uint32_t solid = 0; solid < scene_.unbounded_count; ++solid) solids.push_back(solid);
    const kernel::ray3 r = to_kernel(ray);
    const kernel::slab_ray slab =
        kernel::make_slab_ray(kernel::offset_from(kernel::frame_center(&frame_), r.o), r.d, frame_.radius, t_min);
    kernel::bvh_cursor cursor = kernel::bvh_over(slab.hits_sphere ? frame_.node_count : 0);
    while (const std::uint32_t leaf = kernel::next_leaf(slab, scene_.nodes.data(), &cursor)) {
        const std::uint32_t first = leaf >> BVH_LEAF_SHIFT;
        for (std::uint32_t i = 0; i < (leaf & BVH_LEAF_MASK); ++i) solids.push_back(first + i);
    }
}

void SceneRays::append_boundaries(std::uint32_t solid, const Ray& ray, double t_min,
                                  std::vector<kernel::Boundary>& boundaries) const {
    const kernel::ray3 r = to_kernel(ray);
    const kernel::SolidRecord& record = scene_.solids[solid];
    const std::uint32_t segments = kernel::collect(geometry_, record, solid, r, t_min, nullptr);
    if (segments == 0) return;
    const std::size_t first = boundaries.size();
    boundaries.resize(first + 2 * std::size_t{segments});
    kernel::collect(geometry_, record, solid, r, t_min, boundaries.data() + first);
}

void SceneRays::boundaries(const Ray& ray, double t_min, std::vector<kernel::Boundary>& boundaries) const {
    std::vector<std::uint32_t> solids;
    candidates(ray, t_min, solids);
    boundaries.clear();
    for (const std::uint32_t solid : solids) append_boundaries(solid, ray, t_min, boundaries);
}

double SceneRays::tolerance(const Ray& ray) const { return kernel::tolerance_along(&frame_, to_kernel(ray)); }

kernel::vec3 SceneRays::normal(const Ray& ray, const kernel::Boundary& end) const {
    return kernel::normal_at(geometry_, scene_.solids[end.solid], to_kernel(ray), end.t, end.surface);
}

}  // namespace csgrt::bench
