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

/// A leaf's matrix.
void check_matrix(const TreeNode& leaf, const Report& report);

/// Colour, finish, operators and matrices. Names are not looked up.
void check_combination(const Combination& combination, const Report& report);

}  // namespace csgrt
