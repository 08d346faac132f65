// Hash of a compiled scene: one number for all data that the device gets.
#pragma once

#include <cstdint>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// FNV-1a over all bytes that the device gets. Equal scenes give equal hashes, on all machines of one byte order.
std::uint64_t hash_of(const CompiledScene& scene);
/// The part of Appearance::materials_hash that is a region's.
std::uint64_t hash_of_material(std::size_t region, const kernel::MaterialRecord& material);
/// CompiledScene::geometry_hash, with which hash_of() begins.
std::uint64_t hash_of_geometry(const CompiledScene& scene);

}  // namespace csgrt
