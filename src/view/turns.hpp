// Turns: threads use something one after the other, first come, first served.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>

namespace csgrt {

class Turns {
public:
    static constexpr std::chrono::milliseconds period{5};  ///< between two checks whether a turn is still wanted

    /// A thread's turn, which lasts as long as the object.
    class Turn {
    public:
        /// Waits until all earlier turns are over. The object is false if is_wanted() ended the wait.
        Turn(Turns& of, const std::function<bool()>& is_wanted) : turns_(of) {
            std::unique_lock lock(turns_.mutex_);
            turns_.waiting_.push_back(this);
            bool goes_on = true;
            while (turns_.waiting_.front() != this && goes_on) {
                turns_.changed_.wait_for(lock, period);
                goes_on = is_wanted();
            }
            has_come_ = goes_on && is_wanted();
        }
        ~Turn() {
            const std::lock_guard lock(turns_.mutex_);
            std::erase(turns_.waiting_, this);
            turns_.changed_.notify_all();
        }
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;
        explicit operator bool() const { return has_come_; }

    private:
        Turns& turns_;
        bool has_come_ = false;
    };

private:
    std::mutex mutex_ = {};
    std::condition_variable changed_ = {};
    std::deque<const Turn*> waiting_ = {};  ///< the first has its turn
};

}  // namespace csgrt
