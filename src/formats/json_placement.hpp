// Where a node of a tree stands: "matrix", or "scale", "rotate" and "translate".
#pragma once

#include <optional>

#include <csgrt/scene.hpp>

#include "formats/json_node.hpp"

namespace csgrt {

/// The matrix of a node; nothing if it has none of the keys.
std::optional<Matrix> read_json_placement(const JsonObject& node);

}  // namespace csgrt
