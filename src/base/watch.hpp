// Watch: lets the caller of a call follow its progress and end it.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>

namespace csgrt {

/// Called with the part of the work that is done, 0 to 1. Returns whether to go on.
using Progress = std::function<bool(double)>;

/// Stands between the workers of a call and its followers. Any thread may use it.
class Watch {
public:
    static constexpr std::chrono::milliseconds period{20};  ///< of calls of `progress`

    /// Calls work(watch) and returns when it has returned. If there is a `progress`, work() runs on a thread of its
    /// own, and this thread calls progress(done part): with 0 before the work, every `period` during it, and with 1
    /// after it. If the system has no thread to give, this thread does the work, and calls `progress` before and after.
    /// If `progress` returns false before the work is done, the work has to end soon, and the function throws Error
    /// (interrupted). Throws also what either throws.
    static void over(const Progress& progress, const std::function<void(Watch&)>& work);

    /// Starts counting: done() is from now on a part of so many steps. 0: there are none.
    void begin(std::uint64_t steps) {
        if (!is_all_) steps_ = steps;
    }
    /// Starts counting for several works, each of which calls begin() for its own steps.
    void begin_all(std::uint64_t steps) {
        steps_ = steps;
        is_all_ = true;
    }
    /// Adds so many done steps. Throws Error (interrupted) if the work has to end, and steps are left.
    void add(std::uint64_t steps) {
        if (done_.fetch_add(steps) + steps < steps_) check();
    }
    /// Throws Error (interrupted) if the work has to end.
    void check() const;
    double done() const;

    /// Becomes true when the work has to end. Null: nobody follows it.
    const std::atomic<bool>* stop() const { return is_followed_ ? &stop_ : nullptr; }

private:
    std::atomic<std::uint64_t> steps_{0}, done_{0};
    std::atomic<bool> stop_{false};
    bool is_followed_ = false, is_all_ = false;
};

}  // namespace csgrt
