// A compiled scene of which only some regions claim partitions.
#pragma once

#include <cstdint>
#include <vector>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// The same regions, trees and solids under the same numbers; those with `claims` 0 claim nothing, as if they were not
/// there. Shares all but the solids' records and the starts.
CompiledScene claimed_by(const CompiledScene& scene, std::vector<std::uint8_t> claims);

}  // namespace csgrt
