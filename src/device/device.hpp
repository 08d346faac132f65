// One OpenCL device in use: its context, its queues, each in order, and the count of its memory.
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
/// Commands run in the order in which they are queued, but those of the copy queue and of other queues; several may be
/// queued before one wait.
class Device {
public:
    /// Picks by `choice`: "" (a GPU if there is one, else the first), "cpu", "gpu", "accelerator", a number as in
    /// devices(), or a part of a name. Only devices with double precision are taken.
    /// `max_memory` bounds what all buffers together may take, in bytes; 0: what the device can give.
    /// Throws Error (no_device) that lists what there is, or names the package that brings a device.
    explicit Device(const std::string& choice = "", std::uint64_t max_memory = 0);
    /// `timeout`: as Settings::device_timeout has it.
    explicit Device(const FoundDevice& device, std::uint64_t max_memory = 0, double timeout = -1);
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const noexcept { return info_; }
    const Driver& cl() const noexcept { return *cl_; }
    std::shared_ptr<const Driver> driver() const noexcept { return cl_; }  ///< for what may outlast the device
    cl_device_id id() const noexcept { return id_; }
    cl_context context() const noexcept { return context_.get(); }
    /// Takes what is queued from now on.
    cl_command_queue queue() const noexcept { return queues_[current_].get(); }
    /// Another one, for what comes to the host beside kernels.
    cl_command_queue copy_queue() const noexcept { return copy_queue_.get(); }

    /// While it lives, queue() is another one. Commands of different queues may run side by side.
    class OnQueue;
    static constexpr std::size_t queues = 2;

    /// As long as `stop` is true, no kernel begins: Kernel::launch() throws Error (interrupted), and a native device's
    /// kernels leave out the work-items that have not begun. Null, as at first: none is to end.
    void end_by(const std::atomic<bool>* stop) noexcept { stop_ = stop; }
    bool may_end() const noexcept { return stop_ != nullptr; }
    const std::atomic<bool>* stop() const noexcept { return stop_; }
    /// Throws Error (interrupted) if `stop` is true, and (device_fault) if the device is lost.
    void check_end() const;

    /// Hands what is queued, but for copies and other queues, to the device without waiting.
    void flush() const;
    void flush_copies() const;  ///< the same of copies
    /// Waits until all that is done, of every queue. Throws Error (device_fault, out_of_memory) if the driver says that
    /// something failed.
    void finish() const;

    /// Bytes that all buffers together may take, and that one buffer may take. Devices misreport both, and change their
    /// mind: they are asked each time a Device is made.
    std::uint64_t budget() const noexcept { return budget_; }
    std::uint64_t max_buffer() const noexcept { return max_buffer_; }
    std::uint64_t allocated() const noexcept {
        return allocated_;
    }  ///< bytes now claimed: in buffers, or held by the driver
    std::uint64_t available() const noexcept { return budget_ - allocated_; }
    /// Bytes now in buffers, by the buffers' names.
    const std::map<std::string, std::uint64_t>& allocations() const noexcept { return allocations_; }

    /// Counts `bytes` for a buffer called `name`. Throws Error (out_of_memory), naming who holds what, if they do not
    /// fit.
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
