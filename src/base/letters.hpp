// Letters: conversions between small and capital letters that do not depend on the host's locale.
#pragma once

#include <string>

namespace csgrt {

inline char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

inline char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

inline std::string lower(std::string text) {
    for (char& c : text) c = lower(c);
    return text;
}

}  // namespace csgrt
