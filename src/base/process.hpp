// Process: which process this is. A fork makes another process, which has the memory of the first, but only the forking
// thread of its threads. All in the header, as in new_file.hpp.
#pragma once

#include <atomic>

#ifndef _WIN32
#include <pthread.h>
#endif

namespace csgrt {

inline std::atomic<unsigned> forks{0};
#ifndef _WIN32
[[maybe_unused]] inline const int watched_forks = pthread_atfork(nullptr, nullptr, [] { ++forks; });
#endif

/// A number that differs in a child of fork() from its parent's. Any thread.
inline unsigned process_number() noexcept { return forks.load(std::memory_order_relaxed); }

/// Deletes objects that this process made. Objects from a parent are left alone, which costs only addresses: threads
/// that do not exist here cannot be waited for, and a driver does not know this process.
struct DeleteOwn {
    unsigned process = process_number();
    template <class T>
    void operator()(T* object) const {
        if (process == process_number()) delete object;
    }
};

/// The process that first uses a library whose threads, once started, do not exist in children. Any thread.
class FirstUser {
public:
    bool is_this_process() {
        unsigned before = nobody;
        return user_.compare_exchange_strong(before, process_number()) || before == process_number();
    }

private:
    static constexpr unsigned nobody = ~0u;
    std::atomic<unsigned> user_{nobody};
};

}  // namespace csgrt
