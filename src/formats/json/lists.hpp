// Lists of numbers, places and indices: meshes have millions, so an item becomes a JsonNode only to say what is wrong
// with it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/json/node.hpp"

namespace csgrt {

std::vector<double> read_json_numbers(const JsonNode& list);
std::vector<std::uint32_t> read_json_counts(const JsonNode& list);
std::vector<std::uint8_t> read_json_bytes(const JsonNode& list);  ///< whole numbers from 0 to 255

/// Each vector times `scale`: the file's unit for places, 1 for directions.
std::vector<Vec3> read_json_vectors(const JsonNode& list, double scale);

std::vector<std::array<std::uint32_t, 3>> read_json_triangles(const JsonNode& list);

/// A list of strings, or one string, each of numbers from 0 to `most` with blanks between them. For cells, of which
/// there are millions. With `marks`, '.' is 0 and '#' is `most`, and neither needs a blank.
std::vector<std::uint16_t> read_json_cells(const JsonNode& list, std::uint16_t most, bool marks);

}  // namespace csgrt
