// Copies from the device to the host's memory beside kernels, by a thread of its own, a few at a time, so that what a QueuedRead
// asks for stands behind few of them. (NVIDIA's driver leaves one queue's copies for another's only when none is left, or a
// millisecond has gone by.)
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "device/buffer.hpp"

namespace csgrt {

class CopyFeed {
public:
    /// Lines of `columns` floats, which stand side by side in a buffer from float `begin` on, a multiple of `columns` if they
    /// are several; at the target they begin `pitch` floats apart.
    struct Copy {
        std::size_t begin;
        float* target;
        std::size_t pitch, columns, lines;
    };

    explicit CopyFeed(const Device& device);
    CopyFeed(const CopyFeed&) = delete;
    CopyFeed& operator=(const CopyFeed&) = delete;
    /// Makes all copies first.
    ~CopyFeed();

    /// Makes the copies when those given before are made and `after`, of a queue that was flushed, is done. Does not wait: until
    /// the future is ready the buffer must stay as it is. That throws Error (device_fault, out_of_memory) if a copy failed.
    std::shared_future<void> add(const Buffer& buffer, std::vector<Copy> copies, Event after);

private:
    struct Job {
        const Buffer* buffer;
        std::vector<Copy> copies;
        Event after;
        std::promise<void> done;
        std::exception_ptr failure;
    };
    /// A piece that the device has been given.
    struct Underway {
        Event event;
        std::shared_ptr<Job> job;
        std::size_t bytes;
        bool is_end;  ///< of a job, no piece
    };
    void work();
    void give(const std::shared_ptr<Job>& job);
    void give_piece(const std::shared_ptr<Job>& job, const Copy& copy);
    Event queue_lines(const Job& job, const Copy& copy) const;
    void retire();

    const Device& device_;
    std::deque<std::shared_ptr<Job>> jobs_;
    bool stop_ = false;
    std::mutex mutex_;
    std::condition_variable changed_;
    // The thread's own.
    std::deque<Underway> underway_;
    std::size_t bytes_ = 0;  ///< underway
    std::thread thread_;
};

}  // namespace csgrt
