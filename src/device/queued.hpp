// Queued transfers: the host queues them and goes on with other work. The objects own the memory that the transfers
// need.
#pragma once

#include <bit>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "device/buffer.hpp"

namespace csgrt {

/// A transfer from host to device.
class QueuedUpload {
public:
    QueuedUpload() = default;
    QueuedUpload(const QueuedUpload&) = delete;
    QueuedUpload& operator=(const QueuedUpload&) = delete;
    ~QueuedUpload() {
        wait_until_done(event_);
        if (event_ && event_.cl().is_lost) keep_for_ever(std::make_shared<std::vector<std::byte>>(std::move(bytes_)));
    }

    /// Makes the buffer large enough, and queues a copy of the values to its begin, after all queued commands. Waits
    /// only for this object's previous upload. Throws Error (device_fault, out_of_memory), also about the previous
    /// upload.
    template <class T>
    void start(Buffer& buffer, std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        wait_for(std::exchange(event_, Event()));
        const std::span<const std::byte> bytes = std::as_bytes(values);
        bytes_.assign(bytes.begin(), bytes.end());
        buffer.reserve(bytes_.size());
        event_ = buffer.queue_upload(bytes_.data(), bytes_.size());
    }

private:
    std::vector<std::byte> bytes_;
    Event event_;
};

/// A transfer of few bytes from device to host, which does not wait for all copies of a CopyFeed.
class QueuedRead {
public:
    QueuedRead(Device& device, std::string name) : device_(&device), name_(std::move(name)) {}
    QueuedRead(const QueuedRead&) = delete;
    QueuedRead& operator=(const QueuedRead&) = delete;
    ~QueuedRead() { wait_until_done(event_); }

    /// Registers a read of `bytes` of the buffer from `offset` on. copy() makes the read.
    void start(const Buffer& buffer, std::size_t bytes, std::size_t offset = 0) {
        buffer_ = &buffer;
        bytes_ = bytes;
        offset_ = offset;
    }
    void cancel() { buffer_ = nullptr; }
    /// Queues the copy, if start() was called. Does not wait. The device must have finished all commands that write the
    /// buffer, and the buffer must not change until wait(). Copies that are queued before one wait arrive together.
    void copy() {
        if (buffer_ == nullptr) return;
        if (!memory_ || memory_->size() < bytes_) {
            wait_until_done(event_);  // in case wait() was not called
            memory_.reset();
            memory_.emplace(*device_, name_, std::bit_ceil(bytes_));  // new memory takes half a millisecond
        }
        event_ = std::exchange(buffer_, nullptr)->copy_read(memory_->data(), bytes_, offset_);
    }
    /// Waits for the copy, and returns the first `count` values, which are valid until the next copy(). Throws Error
    /// (device_fault, out_of_memory) if the copy failed; only the event of the command that wrote the values reports
    /// its failure.
    template <class T>
    std::span<const T> wait(std::size_t count) {
        if (count * sizeof(T) > bytes_) throw std::logic_error(name_ + ": more than was asked for");
        if (buffer_ != nullptr) device_->finish();
        copy();
        wait_for(std::exchange(event_, Event()));
        return {static_cast<const T*>(memory_->data()), count};
    }

private:
    Device* device_;
    std::string name_;
    const Buffer* buffer_ = nullptr;  ///< the buffer of start()
    std::size_t bytes_ = 0, offset_ = 0;
    std::optional<PinnedMemory> memory_;  ///< pinned: for other memory, a GPU's driver would copy within the call
    Event event_;
};

}  // namespace csgrt
