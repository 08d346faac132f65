// Where solids stand: the sphere around them, their order and their hierarchy.
#pragma once

#include <cstdint>
#include <vector>

#include "compile/compiled_scene.hpp"

namespace csgrt {

struct NumberedSpace {
    Space space;
    std::vector<std::uint32_t> order;  ///< the instances as solids are numbered
};

/// `boxes`: one an instance, infinite for those that are not bounded; of the others is the sphere. `reaches`: as
/// Clipped has them. What no ray has to meet is left out of the hierarchy, so that solids are numbered as without.
NumberedSpace space_of(const std::vector<Box>& boxes, const std::vector<Box>& reaches);

/// The first leaf with a solid that starts a term, or the number of nodes.
std::uint32_t starting_node(const std::vector<kernel::BvhNode>& nodes, const std::vector<kernel::SolidRecord>& solids);

/// Which of so many solids rays may meet.
std::vector<bool> met_solids(const Space& space, std::size_t solids);

}  // namespace csgrt
