// Lists: an item becomes a JsonNode only for a finding, because meshes have millions of items.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/json/node.hpp"

namespace csgrt {

// Reads an item. False if the item is of another type. Numbers and vectors are multiplied by `scale`.
bool read_plain(const JsonValue& item, double scale, double& value);
bool read_plain(const JsonValue& item, double scale, Vec3& value);
bool read_plain(const JsonValue& item, double, std::uint32_t& value);
bool read_plain(const JsonValue& item, double, std::uint8_t& value);
bool read_plain(const JsonValue& item, double, std::array<std::uint32_t, 3>& value);

/// Reads cells from a string or a list of strings: numbers from 0 to `most`, with blanks between them. With `marks`,
/// '.' stands for 0 and '#' for `most`, and no blanks are needed beside them.
std::vector<std::uint16_t> read_json_cells(const JsonNode& list, std::uint16_t most, bool marks);

}  // namespace csgrt
