// One number for everything that crosses the bus.
#pragma once

#include <cstdint>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// FNV-1a over the numbers that solids are made of and the hierarchy, which is most of it.
std::uint64_t hash_of_geometry(const CompiledScene& scene);
/// FNV-1a over that and all else that the device gets: the same scene gives the same number, on every machine of the
/// same byte order.
std::uint64_t hash_of(const CompiledScene& scene, std::uint64_t geometry);

}  // namespace csgrt
