// Path table: finds regions by path, without a walk over all.
#pragma once

#include <cstdint>
#include <mutex>
#include <string_view>
#include <vector>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// The numbers of regions, by their paths, made at the first use. All scenes whose regions have the same paths under
/// the same numbers share a table. Any thread.
class LatePathTable {
public:
    /// The regions at a path or below it.
    static std::vector<std::uint32_t> find(const CompiledScene& scene, std::string_view path);

private:
    std::once_flag is_made_;
    std::vector<std::uint32_t> sorted_;  ///< by path
};

}  // namespace csgrt
