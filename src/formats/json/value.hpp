// Values: a JSON text as a tree of values that know their positions.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "formats/text_source.hpp"

namespace csgrt {

struct JsonValue;
struct JsonMember;
using JsonArray = std::vector<JsonValue>;
using JsonMembers = std::vector<JsonMember>;  // in the order of the file

/// A value of a JSON text, and its position.
struct JsonValue {
    std::variant<std::nullptr_t, bool, double, std::string, JsonArray, JsonMembers> data;
    std::size_t offset = 0;  ///< position of its first character
};
/// A member of an object, with the position of its name.
struct JsonMember {
    std::string name;
    std::size_t offset = 0;  ///< position of the name's first quote
    JsonValue value;
    bool repeated = false;  ///< an earlier member has the same name; a finding reports this
};

/// The value of the first member with this name, or nullptr.
const JsonValue* find_member(const JsonMembers& members, std::string_view name);

/// Parses the whole text. Syntax errors, numbers beyond a double's range, brackets nested deeper than
/// Limits::file_nesting and repeated names in one object become findings; parsing goes on only after a repeated name.
/// If no value is returned, there is a finding.
std::optional<JsonValue> parse_json(const TextSource& source, Findings& findings);

/// The JSON pointer to a child of the value at `pointer`.
std::string child_pointer(const std::string& pointer, std::string_view name);

}  // namespace csgrt
