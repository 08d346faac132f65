// Copies from the device to the host's memory beside kernels, by a thread of its own, in pieces, few at a time, so that
// what a QueuedRead asks for stands behind few of them. (NVIDIA's driver leaves one queue's copies for another's only
// when none is left, or a millisecond has gone by.) A piece goes straight into memory that the device knows; for other
// memory it goes into pinned memory, from which the thread puts it while the device copies the next one.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "base/thread.hpp"
#include "device/buffer.hpp"

namespace csgrt {

class CopyFeed {
public:
    /// Floats that stand apart as those of a picture's rectangle do: of each channel its lines, one beneath the other.
    /// A line of all channels has at most `piece` floats.
    struct Copy {
        std::size_t columns, lines = 1, channels = 1;
        /// Where the first one is in the buffer; from line to line, and from channel to channel, of which the first
        /// divides the second.
        std::size_t begin = 0, pitch = 0, slice = 0;
        float* target = nullptr;  ///< and on the host
        std::size_t target_pitch = 0, target_slice = 0;

        std::size_t size() const { return columns * lines * channels; }
    };
    static constexpr std::size_t piece = std::size_t{1} << 21;  ///< floats

    explicit CopyFeed(const Device& device);
    CopyFeed(const CopyFeed&) = delete;
    CopyFeed& operator=(const CopyFeed&) = delete;
    /// Makes all copies first.
    ~CopyFeed();

    /// Makes the copies when those given before are made. Does not wait: until the future is ready the buffer must stay
    /// as it is, and what wrote it must be done already. `is_registered`: the target is memory that the device knows.
    /// The future throws Error (device_fault, out_of_memory) if a copy failed.
    std::shared_future<void> add(const Buffer& buffer, std::vector<Copy> copies, bool is_registered);

private:
    struct Job {
        Job(const Buffer& from, std::vector<Copy> all, bool registered)
            : buffer(from), copies(std::move(all)), is_registered(registered) {}
        ~Job() { failure ? done.set_exception(failure) : done.set_value(); }  // when its last piece is made

        const Buffer& buffer;
        std::vector<Copy> copies;
        bool is_registered;
        std::promise<void> done;
        std::exception_ptr failure;
    };
    /// A piece that the device has been given.
    struct Underway {
        std::shared_ptr<Job> job;
        Copy copy;
        const float* staged;  ///< where it comes first; null: nowhere
        Event event;
    };
    void work();
    void give(const std::shared_ptr<Job>& job);
    void give_piece(const std::shared_ptr<Job>& job, const Copy& copy);
    void retire();

    const Device& device_;
    std::deque<std::shared_ptr<Job>> jobs_;
    bool stop_ = false;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<PinnedMemory> staging_;  ///< two pieces
    // The thread's own.
    std::deque<Underway> underway_;
    std::size_t floats_ = 0;        ///< underway
    std::size_t next_ = 0;          ///< the piece of the staging memory that was used longest ago
    std::optional<Thread> thread_;  ///< none: there was none to be had
};

}  // namespace csgrt
