// Validation with an index that is there already.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

#include "scene/names.hpp"

namespace csgrt {

/// csgrt::validate of the scene that `names` is of. What is left out is marked there, and told in `warnings`, which
/// this appends to.
std::vector<Diagnostic> validate(const Scene& scene, Names& names, const std::vector<std::string>& objects,
                                 bool skip_unsupported, std::vector<Warning>& warnings,
                                 std::uint64_t max_instances = 0);

}  // namespace csgrt
