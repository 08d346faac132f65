// Validation with an index that is there already.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

#include "scene/names.hpp"

namespace csgrt {

struct Validated {
    std::vector<Diagnostic> findings;
    /// One an object: how many instances one place of it comes to, what is below it included. Of combinations that no
    /// rendered object uses 0.
    std::vector<std::uint64_t> instances;
};

/// csgrt::validate of the scene that `names` is of. What is left out is marked there, and told in `warnings`, which
/// this appends to.
Validated validate(const Scene& scene, Names& names, const std::vector<std::string>& objects, bool skip_unsupported,
                   std::vector<Warning>& warnings, std::uint64_t max_instances = 0);

}  // namespace csgrt
