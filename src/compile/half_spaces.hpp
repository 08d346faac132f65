// Half-spaces in trees. A half-space that cuts a whole model is in every region's tree and meets every ray, though
// nearly all solids lie on one side of it. Clipping moves the half-space to the solids that it cuts.
#pragma once

#include <vector>

#include <csgrt/scene.hpp>

#include "compile/flatten/flatten.hpp"

namespace csgrt {

/// The result of clipping. The lists are empty if nothing changes.
struct Clipped {
    /// One a region: the region's tree after clipping. A half-space is only at the solids that it cuts, and solids that
    /// are cut away are gone. No nodes: nothing is left of the region.
    std::vector<FlatTree> trees;
    /// One an instance: the box in which rays have to meet the instance. For most solids it is the solid's box. For a
    /// half-space that only bounded regions use, it is the part within `bounded_box`. It is empty if no tree needs the
    /// solid and no remaining solid is near.
    std::vector<Box> ray_boxes;
    Box bounded_box{};  ///< the box around all bounded solids, with a margin greater than the tolerance
};

/// Clips the trees. `boxes`: one an instance, see SolidBoxes::tight.
Clipped clip_by_half_spaces(const Scene& scene, const FlatScene& flat, const std::vector<Box>& boxes);

/// The faces of a box, as planes.
std::vector<Plane> sides_of(const Box& box);

}  // namespace csgrt
