// One number for everything that crosses the bus.
#pragma once

#include <cstdint>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// FNV-1a over all that the device gets: the same scene gives the same number, on every machine of the same byte order.
std::uint64_t hash_of(const CompiledScene& scene);
/// CompiledScene::geometry_hash, which that goes on from.
std::uint64_t hash_of_geometry(const CompiledScene& scene);

}  // namespace csgrt
