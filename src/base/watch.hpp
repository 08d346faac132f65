// A call that its caller follows and may end.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>

namespace csgrt {

/// Is told which part of the work is done, 0 to 1, and says whether to go on.
using Progress = std::function<bool(double)>;

/// Stands between those who work on a call and those who follow it. Any thread may use it.
class Watch {
public:
    static constexpr std::chrono::milliseconds period{20};  ///< of `progress`

    /// Calls work(watch) and returns when it has returned. If there is a `progress`, a thread of its own works, and
    /// this one calls progress(done part): with 0 before the work, every `period` during it, and with 1 behind it.
    /// Where the system has no thread to give, this one works, and calls it before and behind. If `progress` returns
    /// false before the work is done, the work is to end soon, and throws Error (interrupted) then. Throws what either
    /// throws.
    static void over(const Progress& progress, const std::function<void(Watch&)>& work);

    /// From now on, done() is a part of so many steps. 0: there are none.
    void begin(std::uint64_t steps) {
        if (!is_all_) steps_ = steps;
    }
    /// The same, of several pieces of work, each of which calls begin() for its own.
    void begin_all(std::uint64_t steps) {
        steps_ = steps;
        is_all_ = true;
    }
    /// So many more are done. Throws Error (interrupted) if the work is to end, and some are left.
    void add(std::uint64_t steps) {
        if (done_.fetch_add(steps) + steps < steps_) check();
    }
    /// Throws Error (interrupted) if the work is to end.
    void check() const;
    double done() const;

    /// Becomes true when the work is to end. Null: nobody follows it.
    const std::atomic<bool>* stop() const { return is_followed_ ? &stop_ : nullptr; }

private:
    std::atomic<std::uint64_t> steps_{0}, done_{0};
    std::atomic<bool> stop_{false};
    bool is_followed_ = false, is_all_ = false;
};

}  // namespace csgrt
