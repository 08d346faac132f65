// Changes to the trees of a scene that leave the paths of all other instances as they are.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

// All throw Error (usage), and then nothing has changed, where a path leads nowhere or to no such thing.

/// Sets the matrix of the last leg of a path. `alone`: for this instance; combinations on the way that have other
/// places, or are among the `rendered` objects, are copied.
void set_leg_matrix(Scene& scene, const std::vector<std::string>& rendered, const std::string& path,
                    const Matrix& matrix, bool alone);
/// Takes the last leg of a path out of its tree. Of the operator above it the other operands stay; what a difference
/// takes away from it goes, too.
void remove_leg(Scene& scene, const std::string& path);
/// Makes the tree of the combination at the end of a path `tree op leg`.
void add_leg(Scene& scene, const std::string& path, Operator op, const std::string& object, const Matrix& matrix);
/// Gives the solid at the end of a path another shape.
void replace_shape(Scene& scene, const std::string& path, Shape shape);

}  // namespace csgrt
