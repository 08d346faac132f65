// Claimed by: makes a compiled scene in which only some regions claim partitions.
#pragma once

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// Returns a scene with the same regions, trees and solids under the same numbers. Regions of another state claim
/// nothing, as if they did not exist. The result shares everything except the solids' records and the starts.
CompiledScene claimed_by(const CompiledScene& scene, State state);

}  // namespace csgrt
