// Lists: their items become JsonNodes only for a finding, since meshes have millions.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/json/node.hpp"

namespace csgrt {

// Reads an item. False if it is not what it should be. Numbers and vectors are multiplied by `scale`.
bool read_plain(const JsonValue& item, double scale, double& value);
bool read_plain(const JsonValue& item, double scale, Vec3& value);
bool read_plain(const JsonValue& item, double, std::uint32_t& value);
bool read_plain(const JsonValue& item, double, std::uint8_t& value);
bool read_plain(const JsonValue& item, double, std::array<std::uint32_t, 3>& value);

/// Reads cells, of which there are millions: a list of strings, or one string, each of numbers from 0 to `most` with
/// blanks between them. With `marks`, '.' is 0 and '#' is `most`, and neither needs a blank.
std::vector<std::uint16_t> read_json_cells(const JsonNode& list, std::uint16_t most, bool marks);

}  // namespace csgrt
