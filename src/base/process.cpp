#include "base/process.hpp"

#ifndef _WIN32
#include <atomic>

#include <pthread.h>
#endif

namespace csgrt {

#ifdef _WIN32
unsigned process_number() noexcept { return 0; }
#else
namespace {

std::atomic<unsigned> forks{0};
[[maybe_unused]] const int watched = pthread_atfork(nullptr, nullptr, [] { ++forks; });

}  // namespace

unsigned process_number() noexcept { return forks.load(std::memory_order_relaxed); }
#endif

}  // namespace csgrt
