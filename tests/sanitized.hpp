// CSGRT_SANITIZED: the tests run under the address or the thread sanitizer. g++ says so by a macro, Clang by a feature.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CSGRT_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CSGRT_SANITIZED
#endif
#endif

namespace csgrt::test {

#ifdef CSGRT_SANITIZED
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// How often random cases are tried: the sanitizers look at what is run, not at how often.
constexpr int tries(int number) { return sanitized ? (number + 15) / 16 : number; }

}  // namespace csgrt::test
