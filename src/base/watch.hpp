// Watch: lets the caller of a call follow its progress and end it.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>

namespace csgrt {

/// A function that is called with the done fraction of the work, 0 to 1, and returns whether to go on.
using Progress = std::function<bool(double)>;

/// Tells a call's caller how much of the work is done, and the workers when to stop. Any thread may use it.
class Watch {
public:
    static constexpr std::chrono::milliseconds period{20};  ///< between two calls of `progress`

    /// Calls work(watch) and returns when it has returned. If there is a `progress`, work() runs on a thread of its
    /// own, and this thread calls progress(done part): with 0 before the work, every `period` during it, and with 1
    /// after it. If the system gives no thread, this thread does the work, and calls `progress` only before and after.
    /// If `progress` returns false before the work is done, the work has to end soon, and over() throws Error
    /// (interrupted). over() passes on exceptions of `progress` and work().
    static void over(const Progress& progress, const std::function<void(Watch&)>& work);

    /// Starts counting: done() becomes the fraction of `steps` that are done. With 0 steps, done() is 0.
    void begin(std::uint64_t steps) {
        if (!is_all_) steps_ = steps;
    }
    /// Starts counting the steps of several works together: begin(), which each work calls, then has no effect.
    void begin_all(std::uint64_t steps) {
        steps_ = steps;
        is_all_ = true;
    }
    /// Adds to the number of done steps. Throws Error (interrupted) if the work has to end and steps are left.
    void add(std::uint64_t steps) {
        if (done_.fetch_add(steps) + steps < steps_) check();
    }
    /// Throws Error (interrupted) if the work has to end.
    void check() const;
    double done() const;

    /// Becomes true when the work has to end. Null: there is no `progress`, so the work never has to end.
    const std::atomic<bool>* stop() const { return is_followed_ ? &stop_ : nullptr; }

private:
    std::atomic<std::uint64_t> steps_{0}, done_{0};
    std::atomic<bool> stop_{false};
    bool is_followed_ = false, is_all_ = false;
};

}  // namespace csgrt
