// Device: one OpenCL device in use, with its context, its queues and the count of its memory.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include <csgrt/renderer.hpp>

#include "device/opencl/opencl.hpp"

namespace csgrt {

struct FoundDevice;

/// A context and profiling queues on one device. Buffers, programs and kernels refer to it and must not outlive it.
/// Commands of one queue run in the order in which they are queued. Commands of different queues may overlap.
class Device {
public:
    /// Opens the device of `choice`: "" (a GPU if there is one, else the first device), "cpu", "gpu", "accelerator", a
    /// number as in devices(), or a part of a name. Only devices with double precision are accepted. `max_memory`
    /// limits the bytes of all buffers together; 0: what the device can give. Throws Error (no_device) that lists the
    /// devices, or names the package that brings a device.
    explicit Device(const std::string& choice = "", std::uint64_t max_memory = 0);
    /// Opens a device that was found. `timeout`: as in Settings::device_timeout.
    explicit Device(const FoundDevice& device, std::uint64_t max_memory = 0, double timeout = -1);
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const noexcept { return info_; }
    const Driver& cl() const noexcept { return *cl_; }
    std::shared_ptr<const Driver> driver() const noexcept { return cl_; }  ///< for objects that may outlive the device
    cl_device_id id() const noexcept { return id_; }
    cl_context context() const noexcept { return context_.get(); }
    /// The queue for the next commands.
    cl_command_queue queue() const noexcept { return queues_[current_].get(); }
    /// The queue for copies to the host while kernels run.
    cl_command_queue copy_queue() const noexcept { return copy_queue_.get(); }

    /// Chooses another queue for queue() while the object lives.
    class OnQueue;
    static constexpr std::size_t queues = 2;

    /// Sets the flag that ends work. While `stop` is true, Kernel::launch() throws Error (interrupted), and a running
    /// kernel of a native device begins no further work-items. Null, the default: work is never ended.
    void end_by(const std::atomic<bool>* stop) noexcept { stop_ = stop; }
    bool may_end() const noexcept { return stop_ != nullptr; }
    const std::atomic<bool>* stop() const noexcept { return stop_; }
    /// Throws Error (interrupted) if `stop` is true, and (device_fault) if the device is lost.
    void check_end() const;

    /// Hands the current queue's commands to the device, without waiting.
    void flush() const;
    void flush_copies() const;  ///< hands queued copies to the device
    /// Waits until the commands of every queue are done. Throws Error (device_fault, out_of_memory) if the driver
    /// reports a failure.
    void finish() const;

    /// The bytes that all buffers together may take, and that one buffer may take. The numbers that devices report are
    /// unreliable and change, so they are read whenever a Device is made.
    std::uint64_t budget() const noexcept { return budget_; }
    std::uint64_t max_buffer() const noexcept { return max_buffer_; }
    std::uint64_t allocated() const noexcept {
        return allocated_;
    }  ///< bytes in buffers, and other bytes that the driver holds
    std::uint64_t available() const noexcept { return budget_ - allocated_; }
    /// Bytes now in buffers, by the buffers' names.
    const std::map<std::string, std::uint64_t>& allocations() const noexcept { return allocations_; }

    /// Counts `bytes` for a buffer with the name `name`. Throws Error (out_of_memory), with a list of all buffers, if
    /// the bytes exceed the budget.
    void claim(const std::string& name, std::uint64_t bytes);
    void release(const std::string& name, std::uint64_t bytes) noexcept;

private:
    DeviceInfo info_;
    std::shared_ptr<const Driver> cl_;
    cl_device_id id_ = nullptr;
    Context context_;
    std::array<Queue, queues> queues_;
    Queue copy_queue_;
    std::size_t current_ = 0;
    const std::atomic<bool>* stop_ = nullptr;
    std::uint64_t budget_ = 0, max_buffer_ = 0, allocated_ = 0;
    std::map<std::string, std::uint64_t> allocations_;
};

class Device::OnQueue {
public:
    OnQueue(Device& device, std::size_t queue) noexcept : device_(device) { device_.current_ = queue; }
    OnQueue(const OnQueue&) = delete;
    OnQueue& operator=(const OnQueue&) = delete;
    ~OnQueue() { device_.current_ = 0; }

private:
    Device& device_;
};

}  // namespace csgrt
