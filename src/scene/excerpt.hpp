// Excerpt: the line of a file that a diagnostic shows, and a caret under the column.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <csgrt/error.hpp>

namespace csgrt {

/// The part of a line around a column (in bytes, from 0), short enough for a terminal, and on the next line a caret
/// under the column.
std::string excerpt(std::string_view line, std::size_t column);

/// The excerpt for a finding that is made after the file was read. Empty if the place has no line, or the file cannot
/// be read again.
std::string excerpt(const Place& place);

}  // namespace csgrt
