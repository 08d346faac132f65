// Copy feed: a thread that copies from the device to the host's memory while kernels run. It makes chunks and queues
// few of them at a time, so that the small copy of a QueuedRead waits for few chunks. (NVIDIA's driver changes from one
// queue's copies to another's only when the queue is empty, or after a millisecond.) The device copies a chunk directly
// to registered memory. For other memory it copies to pinned memory, and the thread copies on from there while the
// device copies the next chunk.
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

/// A queue of copies, and the thread that makes them.
class CopyFeed {
public:
    /// A rectangle of a picture: consecutive lines of several channels. One line of all channels together has at most
    /// `chunk` floats.
    struct Copy {
        std::size_t columns, lines = 1, channels = 1;
        /// The first float's index in the buffer; the distance in floats from line to line; and from channel to
        /// channel, a multiple of the pitch.
        std::size_t begin = 0, pitch = 0, slice = 0;
        float* target = nullptr;  ///< the first float on the host
        std::size_t target_pitch = 0, target_slice = 0;

        std::size_t size() const { return columns * lines * channels; }
    };
    static constexpr std::size_t chunk = std::size_t{1} << 21;  ///< floats

    explicit CopyFeed(const Device& device);
    CopyFeed(const CopyFeed&) = delete;
    CopyFeed& operator=(const CopyFeed&) = delete;
    /// Waits until all copies are done.
    ~CopyFeed();

    /// Queues copies, after those of earlier calls, and does not wait. The buffer's contents must be complete, and must
    /// not change until the future is ready. `is_registered`: the target is in a HostRegistration. The future throws
    /// Error (device_fault, out_of_memory) if a copy failed.
    std::shared_future<void> add(const Buffer& buffer, std::vector<Copy> copies, bool is_registered);

private:
    struct Job {
        Job(const Buffer& from, std::vector<Copy> all, bool registered)
            : buffer(from), copies(std::move(all)), is_registered(registered) {}
        ~Job() { failure ? done.set_exception(failure) : done.set_value(); }  // runs when the last chunk is copied

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
        const float* staged;  ///< the chunk's position in the staging memory; null: it is copied directly to the target
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
    std::optional<PinnedMemory> staging_;  ///< memory for two chunks
    // Only the thread uses the members below.
    std::deque<Underway> underway_;
    std::size_t floats_ = 0;        ///< number of floats underway
    std::size_t next_ = 0;          ///< the half of the staging memory that was used longest ago
    std::optional<Thread> thread_;  ///< empty if no thread was available
};

}  // namespace csgrt
