// Scenes of any size for the benchmark and the tests: a plate with many small machine parts on it.
#pragma once

#include <cstdint>

#include <csgrt/scene.hpp>

namespace csgrt::stress {

/// Exactly `solids` solids (3 at least), about four a region: tiles with holes, bushings, flanges and rounded tiles
/// on a square grid on one plate, in groups of 16, each with its own sizes and its place by a matrix; one in four is
/// turned. From any side the picture is covered about alike and a ray meets about as many parts, however many there
/// are. The same numbers on every machine: nothing is used but + - * / sqrt and whole numbers.
Scene scene_of_parts(std::uint32_t solids, std::uint64_t seed = 1);

}  // namespace csgrt::stress
