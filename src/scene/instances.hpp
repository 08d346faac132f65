// How many solids a scene expands to, so that one that is too large is refused before memory is spent.
#pragma once

#include <cstdint>
#include <string>

#include <csgrt/scene.hpp>

namespace csgrt {

/// How many instances each place of a solid counts for: 1, or more if it has parts or a name that each place copies.
std::uint64_t instances_of(const Solid& solid);

/// How many instances a scene may have; `max_instances` is that of Settings. The scene must outlive this.
class InstanceLimit {
public:
    InstanceLimit(const Scene& scene, std::uint64_t max_instances);
    bool allows(double count);
    /// "'all' expands to N instances; at most M are allowed", and what to do.
    Diagnostic fault(const Place& place, const std::string& what, double count) const;

private:
    const Scene& scene_;
    std::uint64_t allowed_;
    bool counts_own_;  ///< when more are asked for: twice the scene's own solids are allowed, if these are more
};

}  // namespace csgrt
