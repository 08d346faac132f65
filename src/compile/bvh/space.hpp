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

/// `boxes`: one an instance, infinite for those that are not bounded.
NumberedSpace space_of(const std::vector<Box>& boxes);

}  // namespace csgrt
