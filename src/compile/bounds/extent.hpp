// Where the placed solids of a scene reach: not so far, and none so small, that what is computed of them loses its
// meaning.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compile/flatten/flatten.hpp"
#include "compile/bounds/instance_bounds.hpp"

namespace csgrt {

/// A solid, and what is wrong with it in one of its places.
struct ExtentFault {
    std::uint32_t object;
    std::string text;
};

/// Those that are larger or smaller than Limits allows where they stand.
std::vector<ExtentFault> extent_faults(const Scene& scene, const FlatScene& flat, const Measured& measured);

}  // namespace csgrt
