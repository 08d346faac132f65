// Validation with an index that is there already.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

#include "scene/names.hpp"

namespace csgrt {

/// csgrt::validate of the scene that `names` is of.
std::vector<Diagnostic> validate(const Scene& scene, const Names& names, const std::vector<std::string>& objects,
                                 bool allow_unsupported);

}  // namespace csgrt
