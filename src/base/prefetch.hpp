// Asking for memory ahead, where what is read next lies anywhere and waiting for it would take most of the time.
#pragma once

#include <cstddef>

namespace csgrt {

/// Asks for memory that will be read.
inline void prefetch_line([[maybe_unused]] const void* memory) {
#if defined(__GNUC__)
    __builtin_prefetch(memory);
#endif
}

/// Asks for all of an object.
template <class T>
void prefetch_whole(const T& object) {
    constexpr std::size_t line = 64;
    for (std::size_t i = 0; i < sizeof(T); i += line) prefetch_line(reinterpret_cast<const char*>(&object) + i);
}

}  // namespace csgrt
