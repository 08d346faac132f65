// Half-spaces in trees. One that cuts a whole model stands in every region's tree and meets every ray, though nearly
// all solids lie on one side of it.
#pragma once

#include <vector>

#include <csgrt/scene.hpp>

#include "compile/flatten/flatten.hpp"

namespace csgrt {

/// What half-spaces leave of a scene. Without any, and where nothing else is, the lists are empty: all stays as it is.
struct Clipped {
    /// One a region: as the region's, but half-spaces stand at the solids that they cut, solids beside them have none,
    /// and those that they take away are gone. No nodes: nothing is left of the region.
    std::vector<FlatTree> trees;
    /// One an instance: the box where rays have to meet it. Its own; of a half-space that only bounded regions use,
    /// what of it lies within `end`; empty if no tree needs it and nothing of it is near what is left.
    std::vector<Box> reaches;
    Box end{};  ///< around all bounded solids, farther off than ends of segments that are one
};

/// `boxes`: one an instance, see SolidBoxes::tight.
Clipped clip_by_half_spaces(const Scene& scene, const FlatScene& flat, const std::vector<Box>& boxes);

/// The faces of that box.
std::vector<Plane> sides_of(const Box& box);

}  // namespace csgrt
