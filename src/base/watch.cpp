#include "base/watch.hpp"

#include <algorithm>
#include <system_error>

#include <csgrt/error.hpp>

#include "base/clock.hpp"
#include "base/thread.hpp"

namespace csgrt {

void Watch::over(const Progress& progress, const std::function<void(Watch&)>& work) {
    Watch watch;
    if (!progress) return work(watch);
    watch.is_followed_ = true;
    watch.stop_ = !progress(0);
    watch.check();
    std::future<void> end;
    try {
        end = start_async([&] { work(watch); }, std::launch::async);
    } catch (const std::system_error&) {
        end = std::async(std::launch::deferred, [&] { work(watch); });
    }
    try {
        for (auto next = Clock::now() + period; end.wait_until(next) == std::future_status::timeout;
             next = std::max(next + period, Clock::now()))
            if (!watch.stop_) watch.stop_ = !progress(watch.done());
    } catch (...) {  // the destructor of `end` waits for the work
        watch.stop_ = true;
        throw;
    }
    end.get();
    progress(1);
}

void Watch::check() const {
    if (stop_) throw Error(Status::interrupted, "interrupted");
}

double Watch::done() const {
    const std::uint64_t steps = steps_;
    return steps == 0 ? 0 : std::min(1.0, static_cast<double>(done_) / static_cast<double>(steps));
}

}  // namespace csgrt
