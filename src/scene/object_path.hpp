// Objects as a person names them: "tor.r", or a way down to one of the places where it is used, "all.g/tor.r".
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <csgrt/scene.hpp>

#include "scene/names.hpp"

namespace csgrt {

struct ObjectPath {
    struct Step {
        std::uint32_t object;
        std::uint32_t node;  ///< the leaf that names it, of the tree of the step before; of the first step 0
    };
    std::vector<Step> steps;  ///< the last one's object is what is named; none: there is a fault
    std::string fault, suggestion;

    std::uint32_t object() const { return steps.back().object; }
};

/// An object of the whole name, else the way down that the parts between '/' give; one at the front or the end does not
/// matter. A part is what a leg is called (Names::leg_name): of several places of one object its name is the first's.
ObjectPath find_path(const Scene& scene, const Names& names, const std::string& text);

/// The object that a wrong name was probably meant to be; see did_you_mean.
std::string did_you_mean_object(const Scene& scene, std::string_view wrong);

}  // namespace csgrt
