// Items of lists: meshes have millions, so one becomes a JsonNode only to say what is wrong with it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/json/node.hpp"

namespace csgrt {

// Whether the item is what it should be; then it is read. Numbers and vectors are multiplied by `scale`.
bool read_plain(const JsonValue& item, double scale, double& value);
bool read_plain(const JsonValue& item, double scale, Vec3& value);
bool read_plain(const JsonValue& item, double, std::uint32_t& value);
bool read_plain(const JsonValue& item, double, std::uint8_t& value);
bool read_plain(const JsonValue& item, double, std::array<std::uint32_t, 3>& value);

/// A list of strings, or one string, each of numbers from 0 to `most` with blanks between them. For cells, of which
/// there are millions. With `marks`, '.' is 0 and '#' is `most`, and neither needs a blank.
std::vector<std::uint16_t> read_json_cells(const JsonNode& list, std::uint16_t most, bool marks);

}  // namespace csgrt
