// Space: finds the sphere around all solids, their order and their hierarchy.
#pragma once

#include <cstdint>
#include <vector>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// The hierarchy of a scene, and the numbers that its solids get from it.
struct NumberedSpace {
    Space space;
    std::vector<std::uint32_t> order;  ///< instances, in the order of the solids' numbers
};

/// Numbers the solids and builds their hierarchy. `boxes`: one an instance, infinite for unbounded solids; the sphere
/// is around the bounded solids. `ray_boxes`: as in Clipped. Solids that no ray has to meet are left out of the
/// hierarchy, but keep their numbers.
NumberedSpace space_of(const std::vector<Box>& boxes, const std::vector<Box>& ray_boxes);

/// The index of the first leaf with a solid that starts a term, or the number of nodes.
std::uint32_t starting_node(const std::vector<kernel::BvhNode>& nodes, const std::vector<kernel::SolidRecord>& solids);

/// Tells for each of `solids` solids whether rays may meet it.
std::vector<bool> met_solids(const Space& space, std::size_t solids);

}  // namespace csgrt
