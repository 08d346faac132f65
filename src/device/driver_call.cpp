#include "device/driver_call.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>

#ifdef __linux__
#include <unistd.h>
#endif

#include "base/process.hpp"

namespace csgrt {

namespace {

thread_local int own_calls = 0;  // of the thread that calls exit(), which it does not wait for

class Gate {
public:
    static Gate& of_process() {
        static Gate* const gate = new Gate;  // for ever: threads may wait in it while the process ends
        return *gate;
    }

    void enter() {
        std::unique_lock lock(mutex_);
        // Who is inside may wait for who comes.
        changed_.wait(lock, [this] { return !is_closed_ || inside_ > 0; });
        ++inside_;
        ++own_calls;
    }
    void leave() {
        const std::lock_guard lock(mutex_);
        --inside_;
        --own_calls;
        changed_.notify_all();
    }

    void close() {
        constexpr std::chrono::seconds longest(30);
        if (process_ != process_number()) return;  // a child has none of the threads
        std::unique_lock lock(mutex_);
        is_closed_ = true;
        changed_.wait_for(lock, longest, [this] { return inside_ == own_calls; });
    }

private:
    const unsigned process_ = process_number();
    std::mutex mutex_;
    std::condition_variable changed_;
    int inside_ = 0;
    bool is_closed_ = false;
};

#ifdef __linux__
/// exit() destroys what belongs to the thread that calls it before all else: before what a compiler has made since our
/// handler was registered, too. A program's main thread is nearly always that thread, and does not end otherwise.
struct CloseFirst {
    CloseFirst() = default;
    CloseFirst(const CloseFirst&) = delete;
    CloseFirst& operator=(const CloseFirst&) = delete;
    ~CloseFirst() { Gate::of_process().close(); }
};
void close_first() {
    if (gettid() != getpid()) return;
    static thread_local const CloseFirst at_exit;
}
#else
void close_first() {}
#endif

}  // namespace

DriverCall::DriverCall(bool used) : used_(used) {
    if (!used_) return;
    close_first();
    Gate::of_process().enter();
}

void wait_for_driver_calls_at_exit() {
    static const int registered = std::atexit([] { Gate::of_process().close(); });
    static_cast<void>(registered);
}

DriverCall::~DriverCall() {
    if (used_) Gate::of_process().leave();
}

}  // namespace csgrt
