// Repainting: a compiled scene with other appearances.
#pragma once

#include <string_view>
#include <vector>

#include "compile/appearance.hpp"

namespace csgrt {

/// The numbers of the regions that an appearance concerns. Throws Error (usage) if there are none.
std::vector<std::uint32_t> regions_at(const CompiledScene& scene, const std::string& path);

/// Returns the scene with the appearance `all` and, from the first to the last, those of `looks` in addition to its
/// own. They must leave alone which regions emit light. It shares all that does not change. Throws Error (usage) if one
/// concerns no region.
CompiledScene repainted(const CompiledScene& before, const std::vector<Look>& looks, const SceneAppearance& all);

}  // namespace csgrt
