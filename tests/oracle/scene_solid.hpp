// Any shape as a whole scene asks for it: what a ray does to it, and how sure that is.
#pragma once

#include <functional>
#include <memory>

#include "intersect.hpp"
#include "bounding_sphere.hpp"

namespace csgrt::oracle {

/// A solid of a scene, in its place.
struct SceneSolid {
    std::function<Answer(const Ray&)> answer;
    BoundingSphere bounds = {};
    std::shared_ptr<const ImplicitSolid> implicit = {};  ///< if it is one

    Answer operator()(const Ray& ray) const { return answer(ray); }
};

/// `filtered`: the floating-point filter (filtered_solid.hpp) answers where it can.
SceneSolid scene_solid(ImplicitSolid&& implicit, bool filtered);

/// `skin`: how thick along the ray triangles without thickness are, millimetres.
SceneSolid scene_solid(const Shape& shape, const QAffine& place, double skin, bool filtered);

}  // namespace csgrt::oracle
