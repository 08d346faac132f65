#include "device/copy_feed.hpp"

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace csgrt {
namespace {

// A piece is worth the time in which a copy begins, 4 microseconds; with two underway, the bus has no pause.
constexpr std::size_t piece = std::size_t{1} << 20;  // floats
constexpr std::size_t most_underway = 2 * piece * sizeof(float);

}  // namespace

CopyFeed::CopyFeed(const Device& device) : device_(device) {
    try {
        thread_ = std::thread([this] { work(); });
    } catch (const std::system_error&) {  // no more threads: add() waits
    }
}

CopyFeed::~CopyFeed() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    changed_.notify_one();
    if (thread_.joinable()) thread_.join();
}

std::shared_future<void> CopyFeed::add(const Buffer& buffer, std::vector<Copy> copies, Event after) {
    for (const Copy& copy : copies)
        if ((copy.begin + copy.columns * copy.lines) * sizeof(float) > buffer.size())
            throw std::logic_error("buffer " + buffer.name() + ": a transfer past its end");
    const auto job = std::make_shared<Job>();
    job->buffer = &buffer;
    job->copies = std::move(copies);
    job->after = std::move(after);
    std::shared_future<void> done = job->done.get_future();
    if (!thread_.joinable()) {
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
            if (copy.lines == 1) {
                for (std::size_t x = 0; x < copy.columns; x += piece)
                    give_piece(job, {copy.begin + x, copy.target + x, copy.pitch, std::min(piece, copy.columns - x), 1});
                continue;
            }
            const std::size_t lines = std::max<std::size_t>(1, piece / std::max<std::size_t>(1, copy.columns));
            for (std::size_t y = 0; y < copy.lines; y += lines)
                give_piece(job, {copy.begin + y * copy.columns, copy.target + y * copy.pitch, copy.pitch, copy.columns,
                                 std::min(lines, copy.lines - y)});
        }
    } catch (...) {
        job->failure = std::current_exception();
    }
    underway_.push_back({Event(), job, 0, true});
}

void CopyFeed::give_piece(const std::shared_ptr<Job>& job, const Copy& copy) {
    constexpr std::size_t size = sizeof(float);
    const std::size_t bytes = copy.columns * copy.lines * size;
    if (bytes == 0) return;
    while (bytes_ > 0 && bytes_ + bytes > most_underway) retire();
    underway_.push_back({Event(), job, bytes, false});
    bytes_ += bytes;
    underway_.back().event = copy.lines == 1 ? job->buffer->copy_read(copy.target, bytes, copy.begin * size, job->after)
                                             : queue_lines(*job, copy);
    device_.flush_copies();
}

Event CopyFeed::queue_lines(const Job& job, const Copy& copy) const {
    constexpr std::size_t size = sizeof(float);
    const std::size_t from[3] = {copy.begin % copy.columns * size, copy.begin / copy.columns, 0}, to[3] = {0, 0, 0},
                      region[3] = {copy.columns * size, copy.lines, 1};
    const cl_event first = job.after.get();
    cl_event event = nullptr;
    check(clEnqueueReadBufferRect(device_.copy_queue(), job.buffer->get(), CL_FALSE, from, to, region, copy.columns * size, 0,
                                  copy.pitch * size, 0, copy.target, first ? 1 : 0, first ? &first : nullptr, &event),
          "clEnqueueReadBufferRect (" + job.buffer->name() + ")");
    return Event(event);
}

/// Waits for the first of those underway.
void CopyFeed::retire() {
    const Underway first = std::move(underway_.front());
    underway_.pop_front();
    bytes_ -= first.bytes;
    if (!first.is_end) {
        try {
            wait_for(first.event);
        } catch (...) {
            if (!first.job->failure) first.job->failure = std::current_exception();
        }
        return;
    }
    if (first.job->failure) {
        first.job->done.set_exception(first.job->failure);
    } else {
        first.job->done.set_value();
    }
}

}  // namespace csgrt
