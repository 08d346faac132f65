#include "device/copy_feed.hpp"

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace csgrt {
namespace {

// A piece is worth the time in which a copy begins, 4 microseconds; with two underway, the bus has no pause
// (docs/experiments/gpu-frames.md).
constexpr std::size_t piece = std::size_t{1} << 21;  // floats
constexpr std::size_t most_underway = 2 * piece * sizeof(float);

std::size_t end_of(const CopyFeed::Copy& copy) {
    return copy.begin + (copy.channels - 1) * copy.slice + (copy.lines - 1) * copy.pitch + copy.columns;
}

}  // namespace

CopyFeed::CopyFeed(const Device& device) : device_(device) {
    try {
        thread_.emplace([this] { work(); });
    } catch (const std::system_error&) {  // no more threads: add() waits
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

std::shared_future<void> CopyFeed::add(const Buffer& buffer, std::vector<Copy> copies) {
    for (const Copy& copy : copies)
        if (copy.size() > 0 && (end_of(copy) * sizeof(float) > buffer.size()))
            throw std::logic_error("buffer " + buffer.name() + ": a transfer past its end");
    const auto job = std::make_shared<Job>();
    job->buffer = &buffer;
    job->copies = std::move(copies);
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
        for (const Copy& copy : job->copies) give_pieces(job, copy);
    } catch (...) {
        job->failure = std::current_exception();
    }
    underway_.push_back({Event(), job, 0, true});
}

// Several channels, or part of one, or of a line.
void CopyFeed::give_pieces(const std::shared_ptr<Job>& job, const Copy& copy) {
    const std::size_t channel = copy.columns * copy.lines;
    const std::size_t channels = std::max<std::size_t>(1, piece / std::max<std::size_t>(1, channel));
    const std::size_t lines = std::max<std::size_t>(1, piece / std::max<std::size_t>(1, copy.columns));
    for (std::size_t p = 0; p < copy.channels; p += channels)
        for (std::size_t y = 0; y<copy.lines; y += channels> 1 ? copy.lines : lines)
            for (std::size_t x = 0; x<copy.columns; x += lines> 1 ? copy.columns : piece) {
                Copy part = copy;
                part.channels = std::min(channels, copy.channels - p);
                part.lines = channels > 1 ? copy.lines : std::min(lines, copy.lines - y);
                part.columns = lines > 1 ? copy.columns : std::min(piece, copy.columns - x);
                part.begin += p * copy.slice + y * copy.pitch + x;
                part.target += p * copy.target_slice + y * copy.target_pitch + x;
                give_piece(job, part);
            }
}

void CopyFeed::give_piece(const std::shared_ptr<Job>& job, const Copy& copy) {
    const std::size_t bytes = copy.size() * sizeof(float);
    while (bytes_ > 0 && bytes_ + bytes > most_underway) retire();
    underway_.push_back({Event(), job, bytes, false});
    bytes_ += bytes;
    underway_.back().event = queue(device_, *job->buffer, copy);
    device_.flush_copies();
}

Event CopyFeed::queue(const Device& device, const Buffer& buffer, const Copy& copy) {
    constexpr std::size_t size = sizeof(float);
    if (copy.size() == 0) return {};
    if (copy.lines == 1 && copy.channels == 1)
        return buffer.copy_read(copy.target, copy.columns * size, copy.begin * size);
    const std::size_t from[3] = {copy.begin % copy.pitch * size, copy.begin / copy.pitch, 0}, to[3] = {0, 0, 0},
                      region[3] = {copy.columns * size, copy.lines, copy.channels};
    const bool is_flat = copy.channels == 1;
    device.cl().check_lost();
    cl_event event = nullptr;
    check(
        device.cl().EnqueueReadBufferRect(device.copy_queue(), buffer.get(), CL_FALSE, from, to, region,
                                          copy.pitch * size, is_flat ? 0 : copy.slice * size, copy.target_pitch * size,
                                          is_flat ? 0 : copy.target_slice * size, copy.target, 0, nullptr, &event),
        "clEnqueueReadBufferRect (" + buffer.name() + ")");
    return Event(device.cl(), event);
}

/// Waits for the first of those underway.
void CopyFeed::retire() {
    const Underway first = std::move(underway_.front());
    underway_.pop_front();
    bytes_ -= first.bytes;
    if (!first.is_end) {
        try {
            wait_patiently(first.event);
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
