// A bound of the distance to a solid's surface: less than 0 inside, and it changes by no more than the distance moved.
// So the surface is no nearer than the bound says.
//
// Each solid has a function g in its own coordinates whose slope is known to be at most s; local = L (p - center)
// stretches no length by more than |L|, L's largest singular value. The bound is g / (s |L|).
#pragma once

#include <string>
#include <vector>

#include <csgrt/vector.hpp>

#include "compile/compiled_scene.hpp"

namespace csgrt::bench {

class DistanceBounds {
public:
    /// Every solid must have one (type_without_distance).
    explicit DistanceBounds(const CompiledScene& scene);
    /// Millimetres.
    double at(std::uint32_t solid, const Vec3& point) const;

private:
    double local(const kernel::SolidRecord& record, const double* p, double x, double y, double z) const;

    const CompiledScene& scene_;
    std::vector<double> factor_;  ///< 1 / (s |L|), by solid
};

/// The first type of solid in the scene that has no such bound; empty: all have.
std::string type_without_distance(const CompiledScene& scene);

}  // namespace csgrt::bench
