// Intersection of one solid alone, by the kernels' own source in double: for tests of the geometry.
#pragma once

#include <cstdint>
#include <vector>

#include "base/laboratory.hpp"
#include "compile/compiled_scene.hpp"

namespace csgrt {

/// An interval of a ray inside one solid, with the normals at both boundaries.
struct SolidSegment {
    double in = 0, out = 0;      ///< may be infinite
    Vec3 in_normal, out_normal;  ///< unit, outward from the solid
};

/// All segments of one ray in one solid, in order. A ray in a face of the solid may have several beside the face, which
/// are joined where they overlap.
std::vector<SolidSegment> intersect_solid(const CompiledScene& scene, std::uint32_t solid, const Ray& ray,
                                          Quartic quartic = Quartic::bracketed);

}  // namespace csgrt
