// Where a node of a tree stands: "matrix", or "scale", "rotate" and "translate"; and where cells do.
#pragma once

#include <optional>

#include <csgrt/scene.hpp>

#include "formats/json/node.hpp"
#include "form/form.hpp"

namespace csgrt {

/// 16 numbers, row by row, as they stand: which of them are lengths depends on what the matrix places.
Matrix read_json_matrix(const JsonNode& node);

/// The matrix of a node; nothing if it has none of the keys.
std::optional<Matrix> read_json_placement(const JsonObject& node);

/// Whether element `i` of a matrix, row by row, is a length.
inline bool is_length(const form::Placement& placement, std::size_t i) { return i < 12 && placement.lengths[i % 4]; }

/// What a file that gives no matrix means: cells as long as the file's unit, at the origin.
inline Matrix usual_placement(const form::Placement& placement, double unit) {
    Matrix m = identity;
    for (const std::size_t i : {std::size_t{0}, std::size_t{5}, std::size_t{10}}) {
        if (is_length(placement, i)) m[i] *= unit;
    }
    return m;
}

}  // namespace csgrt
