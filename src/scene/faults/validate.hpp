// Validation with an index of names that exists already.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

#include "scene/names.hpp"

namespace csgrt {

/// The result of a validation.
struct Validated {
    std::vector<Diagnostic> findings;
    /// One an object: how many instances one transform of it expands to, everything below it included. 0 for
    /// combinations that no rendered object uses.
    std::vector<std::uint64_t> instances;
};

/// Validates, as csgrt::validate does, the scene of `names`. Objects that are left out are marked in `names`, and
/// reported in `warnings`, to which the function appends.
Validated validate(const Scene& scene, Names& names, const std::vector<std::string>& objects, bool skip_unsupported,
                   std::vector<Warning>& warnings, std::uint64_t max_instances = 0);

}  // namespace csgrt
