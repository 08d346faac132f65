// Copy feed: copies from the device to the host's memory beside kernels, on a thread of its own, in chunks, few at a
// time. So the read of a QueuedRead stands behind few of them. (NVIDIA's driver leaves one queue's copies for another's
// only when none is left, or a millisecond has gone by.) A chunk goes straight into memory that the device knows. For
// other memory it goes into pinned memory, from which the thread copies it while the device copies the next.
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

/// A queue of copies with a thread that makes them. Kernels of other queues run meanwhile, and small reads wait for few
/// chunks.
class CopyFeed {
public:
    /// A rectangle of a picture: floats in several channels, of each channel some lines, one beneath the other. A line
    /// of all channels has at most `chunk` floats.
    struct Copy {
        std::size_t columns, lines = 1, channels = 1;
        /// The position of the first float in the buffer; the distance from line to line; and from channel to channel,
        /// a multiple of it.
        std::size_t begin = 0, pitch = 0, slice = 0;
        float* target = nullptr;  ///< the first float on the host
        std::size_t target_pitch = 0, target_slice = 0;

        std::size_t size() const { return columns * lines * channels; }
    };
    static constexpr std::size_t chunk = std::size_t{1} << 21;  ///< floats

    explicit CopyFeed(const Device& device);
    CopyFeed(const CopyFeed&) = delete;
    CopyFeed& operator=(const CopyFeed&) = delete;
    /// Finishes all copies.
    ~CopyFeed();

    /// Makes the copies after those given before. Does not wait: until the future is ready the buffer must stay as it
    /// is, and its contents must be complete already. `is_registered`: the target is memory that the device knows. The
    /// future throws Error (device_fault, out_of_memory) if a copy failed.
    std::shared_future<void> add(const Buffer& buffer, std::vector<Copy> copies, bool is_registered);

private:
    struct Job {
        Job(const Buffer& from, std::vector<Copy> all, bool registered)
            : buffer(from), copies(std::move(all)), is_registered(registered) {}
        ~Job() { failure ? done.set_exception(failure) : done.set_value(); }  // when its last chunk is copied

        const Buffer& buffer;
        std::vector<Copy> copies;
        bool is_registered;
        std::promise<void> done;
        std::exception_ptr failure;
    };
    /// A chunk that the device is copying.
    struct Underway {
        std::shared_ptr<Job> job;
        Copy copy;
        const float* staged;  ///< its position in the staging memory; null: it goes straight to the target
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
    std::optional<PinnedMemory> staging_;  ///< two chunks
    // The members below belong to the thread.
    std::deque<Underway> underway_;
    std::size_t floats_ = 0;        ///< underway
    std::size_t next_ = 0;          ///< the chunk of the staging memory that was used longest ago
    std::optional<Thread> thread_;  ///< none if no thread was available
};

}  // namespace csgrt
