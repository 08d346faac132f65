// Hash of a compiled scene: one number for all data that the device gets.
#pragma once

#include <cstdint>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// FNV-1a over all bytes that the device gets. Equal scenes give equal hashes, on all machines of one byte order.
std::uint64_t hash_of(const CompiledScene& scene);
/// CompiledScene::geometry_hash, with which hash_of() begins.
std::uint64_t hash_of_geometry(const CompiledScene& scene);

}  // namespace csgrt
