// CSGRT_SANITIZED: the tests run under the address or the thread sanitizer. g++ says so by a macro, Clang by a feature.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CSGRT_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CSGRT_SANITIZED
#endif
#endif
