// Device: one OpenCL device in use, with its context, its queues, each in order, and the count of its memory.
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
/// Commands run in the order in which they are queued, except those of the copy queue and of other queues; several may
/// be queued before one wait.
class Device {
public:
    /// Opens the device of `choice`: "" (a GPU if there is one, else the first), "cpu", "gpu", "accelerator", a number
    /// as in devices(), or a part of a name. Only devices with double precision are accepted. `max_memory` limits the
    /// bytes of all buffers together; 0: what the device can give. Throws Error (no_device) that lists the devices, or
    /// names the package that brings a device.
    explicit Device(const std::string& choice = "", std::uint64_t max_memory = 0);
    /// Opens a device that was found. `timeout`: as in Settings::device_timeout.
    explicit Device(const FoundDevice& device, std::uint64_t max_memory = 0, double timeout = -1);
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const noexcept { return info_; }
    const Driver& cl() const noexcept { return *cl_; }
    std::shared_ptr<const Driver> driver() const noexcept { return cl_; }  ///< for objects that may outlast the device
    cl_device_id id() const noexcept { return id_; }
    cl_context context() const noexcept { return context_.get(); }
    /// The queue for the next commands.
    cl_command_queue queue() const noexcept { return queues_[current_].get(); }
    /// The queue for copies to the host beside kernels.
    cl_command_queue copy_queue() const noexcept { return copy_queue_.get(); }

    /// Makes queue() another queue while it lives. Commands of different queues may run side by side.
    class OnQueue;
    static constexpr std::size_t queues = 2;

    /// Sets the flag that ends work: while `stop` is true, no kernel begins: Kernel::launch() throws Error
    /// (interrupted), and a native device's kernels leave out the work-items that have not begun. Null, the default:
    /// nothing ends.
    void end_by(const std::atomic<bool>* stop) noexcept { stop_ = stop; }
    bool may_end() const noexcept { return stop_ != nullptr; }
    const std::atomic<bool>* stop() const noexcept { return stop_; }
    /// Throws Error (interrupted) if `stop` is true, and (device_fault) if the device is lost.
    void check_end() const;

    /// Hands all queued commands to the device without waiting, except copies and other queues.
    void flush() const;
    void flush_copies() const;  ///< hands queued copies to the device
    /// Waits until the commands of every queue are done. Throws Error (device_fault, out_of_memory) if the driver says
    /// that something failed.
    void finish() const;

    /// The bytes that all buffers together may take, and that one buffer may take. Devices report both wrongly, and
    /// their answers change: they are read each time a Device is made.
    std::uint64_t budget() const noexcept { return budget_; }
    std::uint64_t max_buffer() const noexcept { return max_buffer_; }
    std::uint64_t allocated() const noexcept {
        return allocated_;
    }  ///< bytes claimed now: in buffers, or held by the driver
    std::uint64_t available() const noexcept { return budget_ - allocated_; }
    /// Bytes now in buffers, by the buffers' names.
    const std::map<std::string, std::uint64_t>& allocations() const noexcept { return allocations_; }

    /// Counts `bytes` for a buffer with the name `name`. Throws Error (out_of_memory), with a list of the holders, if
    /// they do not fit.
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
