// The native device's threads: they last as long as it is in use, and wait between kernels.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>

#include "base/thread.hpp"

namespace csgrt::native {

class Pool {
public:
    /// `threads`: with the caller's own; 0: one for each processor that the process may use. Where the system gives
    /// fewer, those do.
    explicit Pool(unsigned threads);
    Pool(const Pool&) = delete;
    Pool& operator=(const Pool&) = delete;
    ~Pool();

    unsigned threads() const noexcept { return static_cast<unsigned>(threads_.size()) + 1; }

    /// Calls work() on all threads, the caller's too, and returns when all have returned. It must not throw. One call
    /// at a time.
    void run(const std::function<void()>& work);

private:
    void wait_for_work();

    std::mutex mutex_;
    std::condition_variable begun_, ended_;
    const std::function<void()>* work_ = nullptr;
    std::size_t number_ = 0;   ///< of the work: a thread that has done it waits for another number
    std::size_t running_ = 0;  ///< threads that have it yet to do
    bool stop_ = false;
    JoinedThreads threads_;  // joined before the rest goes
};

}  // namespace csgrt::native
