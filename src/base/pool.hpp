// Pool: the process's threads for computing. A thread is started when a call first needs it, and then waits for further
// calls. The header holds all of the code, as process.hpp does.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <vector>

#include "base/process.hpp"
#include "base/thread.hpp"

namespace csgrt {

/// A pool of threads that several calls share. A call's own thread always works, too, so a call ends even if all
/// threads of the pool are busy.
class Pool {
public:
    /// The pool of this process. It is never destroyed: a program may end, or fork, while threads work.
    static Pool& own() {
        static std::atomic<Pool*> last{nullptr};
        Pool* found = last.load();
        if (found && found->process_ == process_number()) return *found;
        auto* const fresh = new Pool;
        if (last.compare_exchange_strong(found, fresh)) return *fresh;
        delete fresh;  // another thread has made the pool meanwhile
        return *found;
    }

    Pool() = default;
    Pool(const Pool&) = delete;
    Pool& operator=(const Pool&) = delete;
    ~Pool() {
        {
            const std::lock_guard lock(mutex_);
            stop_ = true;
        }
        begun_.notify_all();
    }

    /// Calls work() on this thread, and on up to `threads` - 1 threads of the pool that become free meanwhile. Returns
    /// when all these calls have returned. work() must not throw. run() may be called by several threads and within
    /// work(): all calls share the pool's threads.
    void run(unsigned threads, const std::function<void()>& work) {
        if (threads <= 1) return work();
        Call call{work, threads - 1};
        {
            const std::lock_guard lock(mutex_);
            calls_.push_back(&call);
            while (threads_.size() < threads - 1 && threads_.add([this] { wait_for_work(); })) {
            }
        }
        begun_.notify_all();
        work();
        std::unique_lock lock(mutex_);
        std::erase(calls_, &call);
        call.ended.wait(lock, [&] { return call.running == 0; });
    }

private:
    struct Call {
        const std::function<void()>& work;
        unsigned wanted;  ///< number of further threads that the call wants
        unsigned threads_allowed = csgrt::threads_allowed;
        unsigned running = 0;
        std::condition_variable ended = {};
    };

    void wait_for_work() {
        std::unique_lock lock(mutex_);
        for (;;) {
            begun_.wait(lock, [this] { return stop_ || !calls_.empty(); });
            if (stop_) return;
            Call& call = *calls_.back();  // the latest call, perhaps from within another call's work
            ++call.running;
            if (--call.wanted == 0) calls_.pop_back();
            lock.unlock();
            threads_allowed = call.threads_allowed;
            call.work();
            lock.lock();
            if (--call.running == 0) call.ended.notify_one();
        }
    }

    const unsigned process_ = process_number();
    std::mutex mutex_;
    std::condition_variable begun_;
    std::vector<Call*> calls_;  ///< calls that want threads
    bool stop_ = false;
    JoinedThreads threads_;  // joined before the other members are destroyed
};

}  // namespace csgrt
