// Nearest name: the known name that a misspelt name probably means.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace csgrt {

/// "did you mean 'radius'?", or an empty text if no known name is close. At most about 10^4 known names are compared,
/// so that the search takes milliseconds.
std::string did_you_mean(std::string_view wrong, const std::vector<std::string_view>& known);

}  // namespace csgrt
