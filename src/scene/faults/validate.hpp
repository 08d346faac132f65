// Validation, for callers that already have an index of names.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

#include "scene/names.hpp"

namespace csgrt {

/// The result of a validation.
struct Validated {
    std::vector<Diagnostic> findings;
    /// For each object: the number of instances to which one use of it expands, with all objects below it. 0 for
    /// combinations that no rendered object uses.
    std::vector<std::uint64_t> instances;
};

/// Validates a scene as csgrt::validate does. Marks objects that are left out in `names`, and appends their warnings to
/// `warnings`.
Validated validate(const Scene& scene, Names& names, const std::vector<std::string>& objects, bool skip_unsupported,
                   std::vector<Warning>& warnings, std::uint64_t max_instances = 0);

}  // namespace csgrt
