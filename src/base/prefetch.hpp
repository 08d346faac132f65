// Prefetch: loads memory into the cache ahead, where the addresses are scattered and waiting would take most of the
// time.
#pragma once

#include <cstddef>

namespace csgrt {

/// Prefetches the cache line of an address.
inline void prefetch_line([[maybe_unused]] const void* memory) {
#if defined(__GNUC__)
    __builtin_prefetch(memory);
#endif
}

/// Prefetches all cache lines of an object.
template <class T>
void prefetch_whole(const T& object) {
    constexpr std::size_t line = 64;
    for (std::size_t i = 0; i < sizeof(T); i += line) prefetch_line(reinterpret_cast<const char*>(&object) + i);
}

}  // namespace csgrt
