#include "device/copy_feed.hpp"

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "base/parallel.hpp"

namespace csgrt {
namespace {

// Floats in copies that are underway. A copy takes 4 microseconds to begin, less than a chunk's copy lasts, so two
// chunks keep the bus busy (docs/experiments.md).
constexpr std::size_t most_underway = 2 * CopyFeed::chunk;
constexpr std::size_t floats_a_thread = std::size_t{1} << 19;  // fewer are copied before a thread wakes

std::size_t end_of(const CopyFeed::Copy& copy) {
    return copy.begin + (copy.channels - 1) * copy.slice + (copy.lines - 1) * copy.pitch + copy.columns;
}

/// Copies densely packed values, channel by channel and line by line, to their target.
void put(const CopyFeed::Copy& copy, const float* values) {
    for_chunks(copy.channels * copy.lines, std::max<std::size_t>(1, floats_a_thread / copy.columns), 0,
               [&](std::size_t i, std::size_t last, std::size_t) {
                   for (; i < last; ++i)
                       std::copy_n(
                           values + i * copy.columns, copy.columns,
                           copy.target + i / copy.lines * copy.target_slice + i % copy.lines * copy.target_pitch);
               });
}

}  // namespace

CopyFeed::CopyFeed(const Device& device) : device_(device) {
    try {
        thread_.emplace([this] { work(); });
    } catch (const std::system_error&) {  // there is no thread: add() makes the copies itself
    }
}

CopyFeed::~CopyFeed() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    changed_.notify_one();
    if (thread_) thread_->join();
}

std::shared_future<void> CopyFeed::add(const Buffer& buffer, std::vector<Copy> copies, bool is_registered) {
    for (const Copy& copy : copies)
        if (end_of(copy) * sizeof(float) > buffer.size() || copy.columns * copy.channels > chunk)
            throw std::logic_error("buffer " + buffer.name() + ": a transfer past its end, or of too long lines");
    if (!is_registered && !staging_) staging_.emplace(device_, "staging memory", most_underway * sizeof(float));
    const auto job = std::make_shared<Job>(buffer, std::move(copies), is_registered);
    std::shared_future<void> done = job->done.get_future();
    if (!thread_) {
        give(job);
        while (!underway_.empty()) retire();
        return done;
    }
    {
        const std::lock_guard lock(mutex_);
        jobs_.push_back(job);
    }
    changed_.notify_one();
    return done;
}

void CopyFeed::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        if (jobs_.empty() && !underway_.empty()) {
            lock.unlock();
            retire();
            lock.lock();
            continue;
        }
        changed_.wait(lock, [&] { return stop_ || !jobs_.empty(); });
        if (jobs_.empty()) return;
        const std::shared_ptr<Job> job = std::move(jobs_.front());
        jobs_.pop_front();
        lock.unlock();
        give(job);
        lock.lock();
    }
}

void CopyFeed::give(const std::shared_ptr<Job>& job) {
    try {
        for (const Copy& copy : job->copies) {
            const std::size_t lines = chunk / (copy.columns * copy.channels);
            for (std::size_t y = 0; y < copy.lines; y += lines) {
                Copy part = copy;
                part.lines = std::min(lines, copy.lines - y);
                part.begin += y * copy.pitch;
                part.target += y * copy.target_pitch;
                give_piece(job, part);
            }
        }
    } catch (...) {
        job->failure = std::current_exception();
    }
}

void CopyFeed::give_piece(const std::shared_ptr<Job>& job, const Copy& copy) {
    Copy first = copy;  // the part that the device copies next
    if (!job->is_registered) {
        first.target = static_cast<float*>(staging_->data()) + next_ * chunk;
        first.target_pitch = copy.columns;
        first.target_slice = copy.columns * copy.lines;
        next_ = 1 - next_;
    }
    const float* const staged = job->is_registered ? nullptr : first.target;
    const auto has_place = [&] {
        return floats_ + copy.size() <= most_underway &&
               (!staged || std::ranges::find(underway_, staged, &Underway::staged) == underway_.end());
    };
    while (!has_place()) retire();
    const std::size_t from[3] = {first.begin % first.pitch * sizeof(float), first.begin / first.pitch, 0},
                      to[3] = {0, 0, 0}, region[3] = {first.columns * sizeof(float), first.lines, first.channels};
    underway_.push_back({job, copy, staged, {}});
    floats_ += copy.size();
    device_.cl().check_lost();
    cl_event event = nullptr;
    check(device_.cl().EnqueueReadBufferRect(device_.copy_queue(), job->buffer.get(), CL_FALSE, from, to, region,
                                             first.pitch * sizeof(float), first.slice * sizeof(float),
                                             first.target_pitch * sizeof(float), first.target_slice * sizeof(float),
                                             first.target, 0, nullptr, &event),
          "clEnqueueReadBufferRect (" + job->buffer.name() + ")");
    underway_.back().event = Event(device_.cl(), event);
    device_.flush_copies();
}

/// Waits for the oldest chunk underway.
void CopyFeed::retire() {
    const Underway first = std::move(underway_.front());
    underway_.pop_front();
    Job& job = *first.job;
    floats_ -= first.copy.size();
    try {
        wait_patiently(first.event);
        if (first.staged && !job.failure) put(first.copy, first.staged);
    } catch (...) {
        if (!job.failure) job.failure = std::current_exception();
    }
}

}  // namespace csgrt
