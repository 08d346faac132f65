// Prefetch: loads memory ahead, where the next data lie anywhere and waiting for them would take most of the time.
#pragma once

#include <cstddef>

namespace csgrt {

/// Prefetches the line of an address.
inline void prefetch_line([[maybe_unused]] const void* memory) {
#if defined(__GNUC__)
    __builtin_prefetch(memory);
#endif
}

/// Prefetches all lines of an object.
template <class T>
void prefetch_whole(const T& object) {
    constexpr std::size_t line = 64;
    for (std::size_t i = 0; i < sizeof(T); i += line) prefetch_line(reinterpret_cast<const char*>(&object) + i);
}

}  // namespace csgrt
