// Texts that describe a scene.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>
#include <csgrt/scene.hpp>

#include "cli/commands/commands.hpp"

namespace csgrt::cli {

/// "operators.json part-1 part-2": the scene file's name without its folders, and the objects that the user named.
/// Blanks in names are escaped.
std::string model_text(const SceneArguments& arguments);

/// The box of the bounded regions: six numbers, which `number` converts to text, or "unbounded" or "empty". `in_words`
/// adds "to" and "mm".
std::string bounds_text(const Model& model, bool in_words, std::string (*number)(double));

/// "3 (arb8 2, tor 1)", the most frequent first.
std::string count_text(const std::map<std::string, std::size_t>& by_type);

/// The trees of `objects`, one line a member, `depth` levels deep. The members of a combination are listed once.
std::string tree_text(const Scene& scene, const std::vector<std::string>& objects, int depth);

}  // namespace csgrt::cli
