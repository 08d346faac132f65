// Which process this is. A fork makes another one, which has the memory of the first, and of its threads the one that
// forked. All in the header, as new_file.hpp is.
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

/// Another number in a child of fork() than in its parent. Any thread.
inline unsigned process_number() noexcept { return forks.load(std::memory_order_relaxed); }

/// Deletes what this process made. What it has from a parent stays as it is, which costs nothing but addresses: threads
/// that are not there cannot be waited for, and a driver does not know this process.
struct DeleteOwn {
    unsigned process = process_number();
    template <class T>
    void operator()(T* object) const {
        if (process == process_number()) delete object;
    }
};

/// The process that first uses a library whose threads, once started, no child has. Any thread.
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
