// What every method of the laboratory finds rays with: the library's hierarchy and its intersection of solids, compiled
// for the host in double.
#pragma once

#include <cstdint>
#include <vector>

#include "compile/compiled_scene.hpp"
#include "kernel_host/geometry.hpp"

namespace csgrt::bench {

/// How close ends are one surface, in millimetres: as Tolerance::length has it, which is the reference's default.
double tolerance_of(const CompiledScene& scene);

class SceneRays {
public:
    /// `scene` must outlive it.
    explicit SceneRays(const CompiledScene& scene);

    /// The solids whose boxes the ray meets at t_min or later, ascending. `t_min` may be minus infinity.
    void candidates(const Ray& ray, double t_min, std::vector<std::uint32_t>& solids) const;
    /// Appends the ends of one solid's segments, in then out, that end at t_min or later.
    void append_boundaries(std::uint32_t solid, const Ray& ray, double t_min,
                           std::vector<kernel::Boundary>& boundaries) const;
    /// The ends of all segments along the ray, by ascending solid, as the kernels store them.
    void boundaries(const Ray& ray, double t_min, std::vector<kernel::Boundary>& boundaries) const;
    /// How far along the ray's parameter ends are one surface: tolerance_of(), by the length of the direction.
    double tolerance(const Ray& ray) const;
    /// The outward unit normal at an end.
    kernel::vec3 normal(const Ray& ray, const kernel::Boundary& end) const;

    const CompiledScene& scene() const { return scene_; }

private:
    const CompiledScene& scene_;
    kernel::Geometry geometry_;
    kernel::Frame frame_;
};

}  // namespace csgrt::bench
