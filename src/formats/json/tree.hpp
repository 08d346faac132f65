// Trees (Boolean) of a scene file.
#pragma once

#include <csgrt/scene.hpp>

#include "formats/json/node.hpp"

namespace csgrt {

/// Reads a tree: null (the empty set), {"postfix": [...]}, or nested operators. Nested operators are read recursively;
/// the parser has limited their depth to Limits::file_nesting.
Tree read_json_tree(const JsonNode& node);

}  // namespace csgrt
