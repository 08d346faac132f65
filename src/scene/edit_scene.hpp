// Edits of a scene's trees that keep the paths of all other instances.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

// All functions throw Error (usage), and change nothing, if a path leads nowhere or to an object of another kind.

/// Sets the matrix of the last member of a path. `alone`: for this instance only; combinations on the way that have
/// other instances, or are among the `rendered` objects, are copied.
void set_member_matrix(Scene& scene, const std::vector<std::string>& rendered, const std::string& path,
                       const Matrix& matrix, bool alone);
/// Removes the last member of a path from its tree. The other operands of the operator above it stay; operands that a
/// difference removes from it go, too.
void remove_member(Scene& scene, const std::string& path);
/// Makes the tree of the combination at the end of a path `tree op member`.
void add_member(Scene& scene, const std::string& path, Operator op, const std::string& object, const Matrix& matrix);
/// Gives the solid at the end of a path another shape.
void replace_shape(Scene& scene, const std::string& path, Shape shape);

}  // namespace csgrt
