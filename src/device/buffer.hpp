// Buffers: memory on the device, and host memory that the device reads and writes without an intermediate copy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "device/device.hpp"

namespace csgrt {

/// A named block of device memory, counted against the device's budget. A buffer of size 0 holds no memory: kernels get
/// a null pointer. All transfers throw Error (device_fault, out_of_memory) with the buffer's name.
class Buffer {
public:
    Buffer(Device& device, std::string name, std::size_t bytes = 0);
    /// Makes a buffer with a copy of `values`.
    template <class T>
    Buffer(Device& device, std::string name, const std::vector<T>& values)
        : Buffer(device, std::move(name), values.size() * sizeof(T)) {
        upload(values);
    }
    Buffer(Device& device, std::string name, std::span<const std::byte> bytes)
        : Buffer(device, std::move(name), bytes.size()) {
        upload(bytes.data(), bytes.size());
    }
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;
    ~Buffer();

    const std::string& name() const noexcept { return name_; }
    std::size_t size() const noexcept { return size_; }  ///< bytes
    cl_mem get() const noexcept { return memory_.get(); }

    /// Makes the buffer at least `bytes` large; its contents are lost if it has to grow.
    void reserve(std::size_t bytes);
    void release() noexcept;  ///< gives the memory back

    /// Copies from host to device or back, and waits for it. `offset`: position in the buffer, in bytes.
    void upload(const void* source, std::size_t bytes, std::size_t offset = 0);
    void read(void* target, std::size_t bytes, std::size_t offset = 0) const;
    template <class T>
    void upload(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        upload(values.data(), values.size() * sizeof(T));
    }
    /// Reads `count` values, from number `first` on.
    template <class T>
    std::vector<T> read(std::size_t count, std::size_t first = 0) const {
        static_assert(std::is_trivially_copyable_v<T>);
        return read_by<T>(device_->queue(), count, first);
    }
    /// Reads the first `count` values by the device's copy queue, which does not wait for other queues.
    template <class T>
    std::vector<T> read_beside(std::size_t count) const {
        return read_by<T>(device_->copy_queue(), count, 0);
    }

    /// Maps the first `bytes` into the host's memory. If the device is the host's own processor, nothing is copied.
    class Mapping;
    Mapping map(std::size_t bytes) const;

    /// Queues an upload. The host's memory must not change until the event or the queue is done.
    Event queue_upload(const void* source, std::size_t bytes, std::size_t offset = 0);
    Event queue_read(void* target, std::size_t bytes, std::size_t offset = 0) const;
    /// Queues a read on the device's copy queue, which does not wait for other queues.
    Event copy_read(void* target, std::size_t bytes, std::size_t offset = 0) const;
    /// Fills `bytes` (a multiple of 4) with copies of `value`.
    Event queue_fill(std::uint32_t value, std::size_t bytes, std::size_t offset = 0);

private:
    Event transfer_in(const void* source, std::size_t bytes, std::size_t offset, bool wait);
    Event transfer_out(cl_command_queue queue, void* target, std::size_t bytes, std::size_t offset, bool wait) const;
    void check_range(std::size_t bytes, std::size_t offset) const;
    template <class T>
    std::vector<T> read_by(cl_command_queue queue, std::size_t count, std::size_t first) const {
        const auto values = std::make_shared<std::vector<T>>(count);
        try {
            transfer_out(queue, values->data(), count * sizeof(T), first * sizeof(T), true);
        } catch (...) {
            if (device_->cl().is_lost) keep_for_ever(values);  // the lost device may still write to this memory
            throw;
        }
        return std::move(*values);
    }

    Device* device_;
    std::string name_;
    std::size_t size_ = 0;
    Memory memory_;
};

/// A buffer's mapped contents. The destructor unmaps them.
class Buffer::Mapping {
public:
    Mapping(const Device& device, cl_mem memory, void* data)
        : cl_(device.cl()), queue_(device.queue()), memory_(memory), data_(data) {}
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;
    ~Mapping();

    const void* data() const noexcept { return data_; }

private:
    const Driver& cl_;
    cl_command_queue queue_;
    cl_mem memory_;
    void* data_;
};

/// Registers host memory with a GPU's driver, so that the GPU copies to it at the full speed of its bus. The driver
/// takes as much memory of the device. The contents stay. The host memory must outlive the object; the device need not.
class HostRegistration {
public:
    /// Throws Error (out_of_memory, device_fault) if the driver refuses the memory. If the device is lost, the memory
    /// must never be freed, because the device may still write to it.
    HostRegistration(const Device& device, void* data, std::size_t bytes);
    HostRegistration(HostRegistration&&) noexcept = default;
    HostRegistration& operator=(HostRegistration&&) = delete;
    ~HostRegistration();

    bool is_lost() const noexcept { return driver_->is_lost; }

private:
    std::shared_ptr<const Driver> driver_;
    Queue queue_;
    Memory memory_;
    void* data_ = nullptr;
};

/// Pinned host memory, which a GPU copies to and from at the full speed of its bus. Copies of ordinary memory are
/// several times slower. Pinned memory does not count against the device's budget, though NVIDIA's driver takes as much
/// memory of the device.
class PinnedMemory {
public:
    PinnedMemory(const Device& device, std::string name, std::size_t bytes);
    PinnedMemory(const PinnedMemory&) = delete;
    PinnedMemory& operator=(const PinnedMemory&) = delete;
    ~PinnedMemory();

    void* data() const noexcept { return data_; }
    std::size_t size() const noexcept { return size_; }

private:
    const Device* device_;
    std::size_t size_;
    Memory memory_;
    void* data_ = nullptr;
};

}  // namespace csgrt
