// What is wrong with the scene's settings, a combination's attributes or its tree; each thing on its own.
#pragma once

#include <functional>
#include <string>

#include <csgrt/scene.hpp>

namespace csgrt {

/// Receives a finding: where, what, and what to do.
using Report = std::function<void(const Place& place, std::string message, std::string suggestion)>;

/// Camera, lights, background, tolerance. They have no place but their name.
void check_settings(const Scene& scene, const Report& report);

/// Colour and finish.
void check_attributes(const Combination& combination, const Report& report);
/// Operators and their operands.
void check_tree(const Combination& combination, const Report& report);
/// Where a leaf places its object.
void check_matrix(const TreeNode& leaf, const Report& report);
/// All of these. Names are not looked up.
void check_combination(const Combination& combination, const Report& report);

}  // namespace csgrt
