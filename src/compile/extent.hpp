// Where the placed solids of a scene reach: not so far, and none so small, that what is computed of them loses its meaning.
#pragma once

#include "compile/flatten.hpp"
#include "compile/measured.hpp"

namespace csgrt {

/// Throws Error (scene) with the solids, by name and place, that are larger or smaller than Limits allows where they stand.
void check_extent(const Scene& scene, const FlatScene& flat, const Measured& measured);

}  // namespace csgrt
