// A scene in words.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <csgrt/scene.hpp>

#include "commands.hpp"

namespace csgrt::cli {

/// "operators.json top-1 top-2": the scene file's name without its folders, and the objects that are rendered, blanks
/// in names escaped.
std::string model_text(const Scene& scene, const SceneArguments& arguments);

/// "3 (arb8 2, tor 1)", the most frequent first.
std::string count_text(const std::map<std::string, std::size_t>& by_type);

/// The trees of `objects`, a line a member, `depth` levels below each. Every combination is unfolded once.
std::string tree_text(const Scene& scene, const std::vector<std::string>& objects, int depth);

}  // namespace csgrt::cli
