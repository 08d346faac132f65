// Object paths: objects as a person names them: "tor.r", or a path down to one of its instances, "all.g/tor.r".
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <csgrt/scene.hpp>

#include "scene/names.hpp"

namespace csgrt {

/// The objects on the way from a top object to a named one.
struct ObjectPath {
    struct Step {
        std::uint32_t object;
        std::uint32_t node;  ///< the leaf that names it, of the tree of the step before; 0 for the first step
    };
    std::vector<Step> steps;  ///< the last step's object is the named one; empty: there is a fault
    std::string fault, suggestion;

    std::uint32_t object() const { return steps.back().object; }
};

/// Finds an object of the whole name, else the path that the parts between '/' give; a '/' at the front or the end has
/// no effect. A part is the name of a member (Names::member_name): of several members with one object, the object's own
/// name is that of the first.
ObjectPath find_path(const Scene& scene, const Names& names, const std::string& text);

/// The object that a wrong name was probably meant to be; see did_you_mean.
std::string did_you_mean_object(const Scene& scene, std::string_view wrong);

}  // namespace csgrt
