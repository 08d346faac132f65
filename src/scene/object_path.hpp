// Object paths: find an object by its name, "tor.r", or one of its instances by a path, "all.g/tor.r".
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <csgrt/scene.hpp>

#include "scene/names.hpp"

namespace csgrt {

/// The objects from a top object down to a named object.
struct ObjectPath {
    struct Step {
        std::uint32_t object;
        std::uint32_t node;  ///< the leaf that names the object, in the tree of the previous step; 0 for the first step
    };
    std::vector<Step> steps;  ///< the last step's object is the named object; empty if there is a fault
    std::string fault, suggestion;

    std::uint32_t object() const { return steps.back().object; }
};

/// Finds the object whose name is the whole of `text`, or else follows `text` as a path of names with '/' between them.
/// A '/' at the begin or the end has no effect. Each name is a member's name (Names::member_name). If several members
/// have the same object, the first of them has the object's name.
ObjectPath find_path(const Scene& scene, const Names& names, const std::string& text);

/// As find_path(). Throws Error (usage) if the path leads to no object.
ObjectPath follow_path(const Scene& scene, const Names& names, const std::string& text);

/// A path without the '/' at its ends.
std::string_view bare_path(std::string_view path);

/// A path in the form of regions' paths; "/": all. Throws Error (usage) for an empty path.
std::string normal_path(const std::string& path);

/// Whether a region's path is `path` or lies below it. All lie below "/".
inline bool is_at_or_below(std::string_view region, std::string_view path) {
    return path == "/" || (region.starts_with(path) && (region.size() == path.size() || region[path.size()] == '/'));
}

/// The members on the way down to step `step` of a path.
MemberPath member_path(const ObjectPath& path, std::size_t step);

/// The matrix of the member at step `step` of a path, in the tree of the step before; at step 0 the matrix of a top
/// object.
const Matrix& matrix_of(const Names& names, const ObjectPath& path, std::size_t step);
/// From the coordinates of the object at step `step` of a path to the world's.
Matrix placement_of(const Names& names, const ObjectPath& path, std::size_t step);
// Both functions take other matrices in place of those that `names` has.
const Matrix& matrix_of(const Names& names, const ObjectPath& path, std::size_t step, const MemberMatrices& moved);
Matrix placement_of(const Names& names, const ObjectPath& path, std::size_t step, const MemberMatrices& moved);

/// The suggestion for a misspelt name of an object; see did_you_mean.
std::string did_you_mean_object(const Scene& scene, std::string_view wrong);

}  // namespace csgrt
