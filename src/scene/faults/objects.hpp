// Objects: checks a scene's settings and a combination's attributes and tree, each value by itself.
#pragma once

#include <functional>
#include <string>

#include <csgrt/scene.hpp>

namespace csgrt {

/// Receives a finding: its place, the fault, and a suggestion.
using Report = std::function<void(const Place& place, std::string message, std::string suggestion)>;

/// Checks camera, lights, background and tolerance. The place of such a finding is only a name.
void check_settings(const Scene& scene, const Report& report);

/// Checks colour and finish.
void check_attributes(const Combination& combination, const Report& report);
/// Checks operators and their operands.
void check_tree(const Combination& combination, const Report& report);
/// Checks the transform of a leaf.
void check_matrix(const TreeNode& leaf, const Report& report);
/// Checks the attributes, the tree and its matrices. Names are not looked up.
void check_combination(const Combination& combination, const Report& report);

}  // namespace csgrt
