#include "progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string_view>

#include <unistd.h>

namespace csgrt::cli {

namespace {

constexpr auto patience = std::chrono::seconds(1);  ///< a shorter stage is not shown
constexpr auto interval = std::chrono::milliseconds(200);
constexpr const char* wipe = "\r\033[K";

std::string clock_text(double seconds) {
    auto whole = static_cast<long long>(std::min(std::ceil(seconds), 359'999.0));
    char text[32];
    if (whole >= 3600)
        std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
    else
        std::snprintf(text, sizeof text, "%lld:%02lld", whole / 60, whole % 60);
    return text;
}

}  // namespace

bool on_terminal() {
    const char* terminal = std::getenv("TERM");
    return isatty(STDERR_FILENO) == 1 && terminal && std::string_view(terminal) != "dumb";
}

Progress::Progress(bool wanted) {
    if (wanted && on_terminal()) thread_.add([this] { redraw_until_done(); });
}

Progress::~Progress() {
    {
        std::lock_guard lock(mutex_);
        done_ = true;
    }
    wake_.notify_one();
}

void Progress::stage(std::string name) {
    std::lock_guard lock(mutex_);
    name_ = std::move(name);
    note_.clear();
    range_begin_ = 0;
    range_end_ = 1;
    fraction_ = -1;
    start_ = Clock::now();
}

void Progress::note(std::string text) {
    std::lock_guard lock(mutex_);
    note_ = std::move(text);
}

void Progress::range(double begin, double end) {
    std::lock_guard lock(mutex_);
    range_begin_ = begin;
    range_end_ = end;
}

void Progress::update(double fraction) {
    std::lock_guard lock(mutex_);
    fraction_ = range_begin_ + (range_end_ - range_begin_) * std::clamp(fraction, 0.0, 1.0);
}

void Progress::redraw_until_done() try {
    std::unique_lock lock(mutex_);
    bool drawn = false;
    while (!wake_.wait_for(lock, interval, [this] { return done_; })) {
        auto now = Clock::now();
        bool slow = !name_.empty() && now - start_ >= patience;
        if (!slow && !drawn) continue;
        std::fputs((wipe + (slow ? line(now) : std::string())).c_str(), stderr);
        std::fflush(stderr);
        drawn = slow;
    }
    if (drawn) std::fputs(wipe, stderr);
} catch (const std::bad_alloc&) {  // the line stays as it is
}

std::string Progress::line(Clock::time_point now) const {
    double elapsed = std::chrono::duration<double>(now - start_).count();
    if (fraction_ < 0) return name_ + "  " + clock_text(elapsed) + (note_.empty() ? "" : "  " + note_);
    std::string text = name_ + "  " + std::to_string(static_cast<int>(fraction_ * 100)) + " %";
    if (fraction_ > 0) text += "  " + clock_text(elapsed * (1 - fraction_) / fraction_) + " left";
    return text;
}

}  // namespace csgrt::cli
