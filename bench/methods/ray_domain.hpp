// Where along a ray the methods that search look: in the scene's sphere, and of a region in its solids' boxes.
#pragma once

#include "compile/compiled_scene.hpp"

namespace csgrt::bench {

struct Domain {
    double from = 0, to = 0;
    bool empty() const { return !(from < to); }
};

/// Half the length of the searched part of a ray, millimetres: of the scene's sphere; with unbounded solids, which have
/// no end, four times that.
double search_reach(const CompiledScene& scene);
/// The searched part of the ray, along its parameter.
Domain search_domain(const CompiledScene& scene, const Ray& ray);
/// Where the ray is in a box, grown by a part in 10^9 of `domain`; `domain` where the box is not bounded.
Domain in_box(const Box& box, const Ray& ray, const Domain& domain);

}  // namespace csgrt::bench
