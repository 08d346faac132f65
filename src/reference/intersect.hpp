// Every solid tried, no hierarchy. The geometry is the kernels' own source, so the bits are theirs.
#pragma once

#include <cstdint>
#include <vector>

#include "compile/compiled_scene.hpp"

namespace csgrt {

struct SolidSegment {
    double in = 0, out = 0;      ///< may be infinite
    Vec3 in_normal, out_normal;  ///< unit, outward from the solid
};

/// All segments of one ray in one solid, in order.
std::vector<SolidSegment> intersect_solid(const CompiledScene& scene, std::uint32_t solid, const Ray& ray,
                                          Quartic quartic = Quartic::bracketed);

/// The ends of all segments of one ray, two a segment, by ascending solid; segments that end before `t_min` are left out.
void collect_ends(const CompiledScene& scene, Quartic quartic, const Ray& ray, double t_min,
                  std::vector<kernel::End>& ends);

}  // namespace csgrt
