// Placement: the transform of a tree's node ("matrix", or "scale", "rotate" and "translate"), and of cells.
#pragma once

#include <optional>

#include <csgrt/scene.hpp>

#include "formats/json/node.hpp"
#include "form/form.hpp"

namespace csgrt {

/// Reads 16 numbers, row by row, unchanged: which of them are lengths depends on the use of the matrix.
Matrix read_json_matrix(const JsonNode& node);

/// The matrix of a node; nothing if it has none of the keys.
std::optional<Matrix> read_json_placement(const JsonObject& node);

/// Whether element `i` of a matrix, row by row, is a length.
inline bool is_length(const form::Placement& placement, std::size_t i) { return i < 12 && placement.lengths[i % 4]; }

/// The transform if a file has no matrix: cells as long as the file's unit, at the origin.
inline Matrix usual_placement(const form::Placement& placement, double unit) {
    Matrix m = identity;
    for (const std::size_t i : {std::size_t{0}, std::size_t{5}, std::size_t{10}}) {
        if (is_length(placement, i)) m[i] *= unit;
    }
    return m;
}

}  // namespace csgrt
