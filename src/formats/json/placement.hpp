// Placement: the transform of a tree's node ("matrix", or "scale", "rotate" and "translate"), and of cells.
#pragma once

#include <optional>

#include <csgrt/scene.hpp>

#include "formats/json/node.hpp"
#include "form/form.hpp"

namespace csgrt {

/// Reads 16 numbers, row by row, without scaling lengths, because the matrix's use decides which numbers are lengths.
Matrix read_json_matrix(const JsonNode& node);

/// The matrix of a node. Nothing if the node has none of the keys.
std::optional<Matrix> read_json_placement(const JsonObject& node);

/// Whether element `i` of a matrix, counted row by row, is a length.
inline bool is_length(const form::Placement& placement, std::size_t i) { return i < 12 && placement.lengths[i % 4]; }

/// The default transform of cells: at the origin, with the file's unit as the cells' size.
inline Matrix usual_placement(const form::Placement& placement, double unit) {
    Matrix m = identity;
    for (const std::size_t i : {std::size_t{0}, std::size_t{5}, std::size_t{10}}) {
        if (is_length(placement, i)) m[i] *= unit;
    }
    return m;
}

}  // namespace csgrt
