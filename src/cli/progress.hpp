// Progress on a terminal: one line on standard error, which is erased when the work is done.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>

#include "base/thread.hpp"

namespace csgrt::cli {

/// Shows the current stage, the fraction that is done and the time left, if the stage lasts longer than a second.
/// Silent if standard error is not a terminal. A thread redraws, so that a stage that never reports still shows its
/// elapsed time.
class Progress {
public:
    /// `wanted` false: silent on a terminal, too, for commands that print there themselves.
    explicit Progress(bool wanted = true);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Begins a stage, e.g. "rendering"; its fraction is unknown until the first update. Safe from any thread.
    void stage(std::string name);
    /// Sets a text behind the stage's name, which tells how far it is. Safe from any thread.
    void note(std::string text);
    /// Sets the part of the stage that the next updates cover: fractions `begin` to `end`. A new stage has 0 to 1.
    void range(double begin, double end);
    /// Sets the done fraction of the range, 0..1. Safe from any thread.
    void update(double fraction);

private:
    using Clock = std::chrono::steady_clock;

    void redraw_until_done();
    std::string line(Clock::time_point now) const;

    std::mutex mutex_;
    std::condition_variable wake_;
    std::string name_, note_;
    double range_begin_ = 0, range_end_ = 1;
    double fraction_ = -1;  ///< negative: unknown
    Clock::time_point start_ = Clock::now();
    bool done_ = false;
    JoinedThreads thread_;  ///< at most one thread; joined before the other members are destroyed
};

/// Whether standard error is a terminal that understands escape sequences.
bool on_terminal();

}  // namespace csgrt::cli
