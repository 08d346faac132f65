#include "device/driver_call.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <thread>

#ifdef __linux__
#include <unistd.h>
#endif

#include <csgrt/error.hpp>

namespace csgrt {

namespace {

thread_local int own_calls = 0;  // this thread's calls; the thread that calls exit() does not wait for its own

class Gate {
public:
    static Gate& of_process() {
        static Gate* const gate = new Gate;  // never destroyed: threads may wait in it while the process ends
        return *gate;
    }

    void enter() {
        constexpr std::chrono::seconds longest(3);
        std::unique_lock lock(mutex_);
        // A call inside may wait for another thread's call, so new calls are let in as long as there are calls inside.
        const auto lets_in = [this] { return !is_closed_ || inside_ > 0; };
        const bool is_exit = is_closed_ && closer_ == std::this_thread::get_id();
        if (!(is_exit ? lets_in() : changed_.wait_for(lock, longest, lets_in)))
            throw Error(Status::usage, "the process ends: after exit() no OpenCL device draws");
        go_in();
    }
    bool enter_if_open() {
        const std::lock_guard lock(mutex_);
        if (!is_closed_) go_in();
        return !is_closed_;
    }
    void leave() {
        const std::lock_guard lock(mutex_);
        --inside_;
        --own_calls;
        changed_.notify_all();
    }

    void close() {
        constexpr std::chrono::seconds longest(30);
        if (process_ != process_number()) return;  // a child process has none of the threads
        std::unique_lock lock(mutex_);
        is_closed_ = true;
        closer_ = std::this_thread::get_id();
        changed_.wait_for(lock, longest, [this] { return inside_ == own_calls; });
    }

private:
    void go_in() {
        ++inside_;
        ++own_calls;
    }

    const unsigned process_ = process_number();
    std::mutex mutex_;
    std::condition_variable changed_;
    std::thread::id closer_;
    int inside_ = 0;
    bool is_closed_ = false;
};

#ifdef __linux__
/// Makes exit() wait for driver calls before it destroys anything that they use. exit() destroys the calling thread's
/// thread_local objects first, also before objects that a compiler made after wait_for_driver_calls_at_exit(). The
/// calling thread is nearly always the main thread.
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

DriverCall::DriverCall(bool used, int) noexcept : used_(used) {
    if (used_) used_ = has_begun_ = Gate::of_process().enter_if_open();
}

void wait_for_driver_calls_at_exit() {
    static const int registered = std::atexit([] { Gate::of_process().close(); });
    static_cast<void>(registered);
}

DriverCall::~DriverCall() {
    if (used_) Gate::of_process().leave();
}

}  // namespace csgrt
