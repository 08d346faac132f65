// Paths of regions as others know them.
#pragma once

#include <regex>
#include <string>

namespace csgrt::test {

/// Without the numbers by which csgrt tells legs of one object apart ("/all/wheel@2/hub.r").
inline std::string without_numbers(const std::string& path) {
    static const std::regex number("@[0-9]+(?=/|$)");
    return std::regex_replace(path, number, "");
}

}  // namespace csgrt::test
