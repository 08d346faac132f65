// Instances: counts the solids to which a scene expands, so that too large a scene is refused before it takes memory.
#pragma once

#include <cstdint>
#include <string>

#include <csgrt/scene.hpp>

namespace csgrt {

/// The number of instances that one instance of a solid counts for: 1, or more if the solid has many parts or a long
/// name, which each instance copies.
std::uint64_t instances_of(const Solid& solid);

/// The limit of a scene's instances. `max_instances`: see Settings. The scene must outlive the object.
class InstanceLimit {
public:
    InstanceLimit(const Scene& scene, std::uint64_t max_instances);
    bool allows(double count);
    /// The finding "'all' expands to N instances; at most M are allowed", with a suggestion.
    Diagnostic fault(const Place& place, const std::string& what, double count) const;

private:
    const Scene& scene_;
    std::uint64_t allowed_;
    bool counts_own_;  ///< true: the scene's own solids are not counted yet; if necessary, twice their number is
                       ///< allowed
};

}  // namespace csgrt
