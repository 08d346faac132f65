// Space: finds the sphere around all solids, their order and their hierarchy.
#pragma once

#include <cstdint>
#include <vector>

#include "compile/bvh/build.hpp"
#include "compile/compiled_scene.hpp"

namespace csgrt {

/// The hierarchy of a scene, and the numbers that its solids get from it.
struct NumberedSpace {
    Space space;
    std::vector<std::uint32_t> order;  ///< instances, in the order of the solids' numbers
};

/// Sets the sphere around all bounded solids, from the box around their boxes. Returns whether all solids are bounded.
bool set_sphere(const std::vector<Box>& boxes, Space& space);

/// Numbers the solids and builds their hierarchy. `boxes`: one an instance, infinite for unbounded solids; the sphere
/// is around the bounded solids. `ray_boxes`: as in Clipped. Solids that no ray has to meet are left out of the
/// hierarchy, but keep their numbers. `earlier`: see build_bvh; only if all solids are bounded.
NumberedSpace space_of(const std::vector<Box>& boxes, const std::vector<Box>& ray_boxes,
                       const EarlierHierarchy* earlier = nullptr);

/// The index of the first leaf with a solid that starts a term, or the number of nodes.
std::uint32_t starting_node(const std::vector<kernel::BvhNode>& nodes, const std::vector<kernel::SolidRecord>& solids);

/// Tells for each of `solids` solids whether rays may meet it.
std::vector<bool> met_solids(const Space& space, std::size_t solids);

}  // namespace csgrt
