// Edits of a scene's trees, which leave the paths of all other instances unchanged.
#pragma once

#include <set>
#include <string>
#include <vector>

#include <csgrt/scene.hpp>

#include "scene/names.hpp"

namespace csgrt {

// All functions throw Error (usage), and change nothing, if a path leads to no object or to an object of the wrong
// kind.

/// The number of a path in a list of paths, or the size of the list. A '/' at the front or the end has no effect.
std::size_t position(const std::vector<std::string>& rendered, const std::string& path);
/// Makes an object a top object, or gives a top object another matrix. The scene must have the object.
void add_top(Scene& scene, const std::string& object, const Matrix& matrix);
/// Removes an object from the top objects, if it is one.
void remove_top(Scene& scene, const std::string& object);
/// Sets the matrix of the last member of a path. A path of one part must be among the `rendered` objects, and the top
/// object's matrix is set. `alone`: for this instance only. Then combinations on the path that have other instances, or
/// are among the `rendered` objects, are copied.
void place_object(Scene& scene, const std::vector<std::string>& rendered, const std::string& path, const Matrix& matrix,
                  bool alone);
/// As place_object(), with the matrix that makes the path's placement `matrix` times the present placement.
void move_object(Scene& scene, const std::vector<std::string>& rendered, const std::string& path, const Matrix& matrix,
                 bool alone);
/// Removes the last member of a path from its tree. The other operands of the operator above it stay. But if a
/// difference removes operands from it, these are removed, too.
void remove_member(Scene& scene, const std::string& path);
/// Adds a member to the combination at the end of a path: its tree becomes tree `op` member.
void add_member(Scene& scene, const std::string& path, Operator op, const std::string& object, const Matrix& matrix);
/// Gives the solid at the end of a path another shape. A moved one becomes a combination of the solid's name.
void replace_shape(Scene& scene, const std::string& path, Shape shape, const Matrix& matrix);
/// Removes a path, deletes its object, and what is below it and has no other use. Of the `rendered` objects the path
/// may be one; the caller takes it from their list.
void erase_object(Scene& scene, const std::vector<std::string>& rendered, const std::string& path);

/// Changes that are kept beside a scene, so that the scene need not be copied.
struct SceneChanges {
    MemberMatrices matrices;   ///< replace the matrices of members and of top objects
    std::set<Member> removed;  ///< operands of unions, each of which keeps another operand
    bool operator==(const SceneChanges&) const = default;
};
/// Returns the scene with the changes. `objects`: what is rendered (empty: the top objects).
Scene changed_scene(const Scene& scene, const SceneChanges& changes, const std::vector<std::string>& objects = {});
// The functions below add to `changes` what place_object(), move_object() and remove_member() change in a scene with
// the changes. `names`: the names of the scene without them. False, and nothing has changed: the path leads nowhere,
// or the edit needs a copy of the scene.
bool place_beside(const Names& names, const std::vector<std::string>& rendered, const std::string& path,
                  const Matrix& matrix, bool alone, SceneChanges& changes);
bool move_beside(const Names& names, const std::vector<std::string>& rendered, const std::string& path,
                 const Matrix& matrix, bool alone, SceneChanges& changes);
bool remove_beside(const Names& names, const std::vector<std::string>& rendered, const std::string& path,
                   SceneChanges& changes);

}  // namespace csgrt
