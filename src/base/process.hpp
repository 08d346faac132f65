// Process: tells a process from its children by fork(). A child has a copy of the memory, but only the thread that
// forked. The header holds all of the code, as new_file.hpp does.
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

/// Deletes objects that this process made. A parent's objects are never deleted in a child: their threads, which a
/// destructor would wait for, do not exist here, and a driver does not know this process. Such objects cost only
/// addresses.
struct DeleteOwn {
    unsigned process = process_number();
    template <class T>
    void operator()(T* object) const {
        if (process == process_number()) delete object;
    }
};

/// Remembers the process that first uses a library with threads of its own, which do not exist in children. Any thread.
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
