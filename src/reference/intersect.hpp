// Intersect: intersects a ray with one solid, by the kernels' own source in double. It is for tests of the geometry.
#pragma once

#include <cstdint>
#include <vector>

#include "base/laboratory.hpp"
#include "compile/compiled_scene.hpp"

namespace csgrt {

/// An interval of a ray inside one solid, with the normals at its two boundaries.
struct SolidSegment {
    double in = 0, out = 0;      ///< may be infinite
    Vec3 in_normal, out_normal;  ///< unit, outward from the solid
};

/// All segments of one ray in one solid, in order. A ray in a face of the solid may have several segments beside the
/// face; overlapping segments are joined.
std::vector<SolidSegment> intersect_solid(const CompiledScene& scene, std::uint32_t solid, const Ray& ray,
                                          Quartic quartic = Quartic::bracketed);

}  // namespace csgrt
