// Warnings as the command line prints them.
#pragma once

#include <string>
#include <vector>

#include <csgrt/error.hpp>

namespace csgrt::test {

inline std::vector<std::string> texts(const std::vector<Warning>& warnings) {
    std::vector<std::string> lines;
    for (const Warning& warning : warnings) lines.push_back(format(warning));
    return lines;
}

}  // namespace csgrt::test
