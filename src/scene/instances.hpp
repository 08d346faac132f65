// Instances: the number of solids that a scene expands to, so that a scene that is too large is refused before memory
// is spent.
#pragma once

#include <cstdint>
#include <string>

#include <csgrt/scene.hpp>

namespace csgrt {

/// The number of instances that each transform of a solid counts for: 1, or more if it has parts or a name that each
/// copies.
std::uint64_t instances_of(const Solid& solid);

/// The limit on a scene's instances; `max_instances` is that of Settings. The scene must outlive it.
class InstanceLimit {
public:
    InstanceLimit(const Scene& scene, std::uint64_t max_instances);
    bool allows(double count);
    /// The finding "'all' expands to N instances; at most M are allowed", and what to do.
    Diagnostic fault(const Place& place, const std::string& what, double count) const;

private:
    const Scene& scene_;
    std::uint64_t allowed_;
    bool counts_own_;  ///< only when more are needed: twice the scene's own solids are allowed, if these are more
};

}  // namespace csgrt
