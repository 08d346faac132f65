// Nearest name: the known name that a wrong name was probably meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace csgrt {

/// "did you mean 'radius'?", or nothing if no known name is close. Of very many known names the first are compared,
/// some 10^4, so that it takes milliseconds.
std::string did_you_mean(std::string_view wrong, const std::vector<std::string_view>& known);

}  // namespace csgrt
