// Where a node of a tree stands: "matrix", or "scale", "rotate" and "translate".
#pragma once

#include <optional>

#include <csgrt/scene.hpp>

#include "formats/json/node.hpp"

namespace csgrt {

/// 16 numbers, row by row, as they stand: which of them are lengths depends on what the matrix places.
Matrix read_json_matrix(const JsonNode& node);

/// The matrix of a node; nothing if it has none of the keys.
std::optional<Matrix> read_json_placement(const JsonObject& node);

}  // namespace csgrt
