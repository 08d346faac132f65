// Half-spaces in trees. A half-space that cuts a whole model stands in every region's tree and meets every ray, though
// nearly all solids lie on one side of it. Clipping moves it to the solids that it cuts.
#pragma once

#include <vector>

#include <csgrt/scene.hpp>

#include "compile/flatten/flatten.hpp"

namespace csgrt {

/// The result of clipping. The lists are empty if nothing changes.
struct Clipped {
    /// One a region: the region's tree, with half-spaces at the solids that they cut, without them at solids that they
    /// hold, and without the solids that they take away. No nodes: nothing is left of the region.
    std::vector<FlatTree> trees;
    /// One an instance: the box in which rays have to meet it. For most solids it is their own box; for a half-space
    /// that only bounded regions use, its part within `end`; empty if no tree needs the solid and nothing that is left
    /// is near it.
    std::vector<Box> ray_boxes;
    Box end{};  ///< the box around all bounded solids, farther off than boundaries that are one
};

/// Clips the trees. `boxes`: one an instance, see SolidBoxes::tight.
Clipped clip_by_half_spaces(const Scene& scene, const FlatScene& flat, const std::vector<Box>& boxes);

/// The faces of a box, as planes.
std::vector<Plane> sides_of(const Box& box);

}  // namespace csgrt
