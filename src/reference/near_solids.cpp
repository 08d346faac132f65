#include "reference/near_solids.hpp"

#include <limits>

#include "compile/bvh/space.hpp"
#include "compile/linear.hpp"

namespace csgrt {

NearSolids::NearSolids(const CompiledScene& scene)
    : count_(scene.solid_boxes.size()), groups_((count_ + size - 1) / size) {
    const std::vector<bool> met = met_solids(scene, count_);
    for (std::size_t i = 0; i < count_; ++i) {
        Spheres& spheres = groups_[i / size];
        const auto set = [&](const Vec3& center, double radius2) {
            spheres.x[i % size] = center.x;
            spheres.y[i % size] = center.y;
            spheres.z[i % size] = center.z;
            spheres.radius2[i % size] = radius2;
        };
        if (!met[i]) {
            set({}, -std::numeric_limits<double>::infinity());
            continue;
        }
        const Box& box = scene.solid_boxes[i];
        if (!is_finite(box)) {
            set({}, std::numeric_limits<double>::infinity());
            continue;
        }
        // The sphere has a margin, so that it is larger than the box even if the box is flat or, by mistake, empty.
        const double radius = 0.75 * diagonal(box) + 1e-6 * scene.radius;
        set(narrow(0.5L * (wide(box.low) + wide(box.high))), radius * radius);
    }
}

}  // namespace csgrt
