// Load faults: the reasons why a library was not loaded, from the words of dlerror().
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace csgrt {

/// Whether a library was not loaded for lack of memory.
inline bool lacked_memory(std::string_view why) {
    constexpr std::array<std::string_view, 4> words = {"annot allocate", "failed to map segment",
                                                       "cannot create shared object descriptor", "out of memory"};
    return std::ranges::any_of(words, [&](std::string_view part) { return why.find(part) != why.npos; });
}

}  // namespace csgrt
