// JSON text for people: a value that fits is on one line, larger values have a line for each part, and long lists of
// numbers fill their lines.
#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace csgrt {

/// Appends a value whose first line begins at `column` and whose later lines are indented by `indent` blanks. Numbers
/// are the shortest that read back to the same double. Numbers must be finite, and strings must be UTF-8.
void append_json(std::string& out, const nlohmann::ordered_json& value, std::size_t indent, std::size_t column);

/// A string in quotes.
std::string json_string(const std::string& text);
/// A string in quotes whose bytes that are not UTF-8 are replaced: names of old databases may be in any encoding.
std::string readable_json_string(const std::string& text);

/// The shortest text that reads back to the same double. The text of -0 is "-0.0".
std::string json_number(double value);

}  // namespace csgrt
