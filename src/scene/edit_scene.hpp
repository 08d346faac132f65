// Edits of a scene's trees, which leave the paths of all other instances unchanged.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

// All functions throw Error (usage), and change nothing, if a path leads to no object or to an object of the wrong
// kind.

/// Sets the matrix of the last member of a path. `alone`: for this instance only. Then combinations on the path that
/// have other instances, or are among the `rendered` objects, are copied.
void set_member_matrix(Scene& scene, const std::vector<std::string>& rendered, const std::string& path,
                       const Matrix& matrix, bool alone);
/// Removes the last member of a path from its tree. The other operands of the operator above it stay. But if a
/// difference removes operands from it, these are removed, too.
void remove_member(Scene& scene, const std::string& path);
/// Adds a member to the combination at the end of a path: its tree becomes tree `op` member.
void add_member(Scene& scene, const std::string& path, Operator op, const std::string& object, const Matrix& matrix);
/// Gives the solid at the end of a path another shape.
void replace_shape(Scene& scene, const std::string& path, Shape shape);

}  // namespace csgrt
