// OpenCL for src/device: handles that free their objects, checks that name the failed call, waits, and times of events.
#pragma once

#include <atomic>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "device/opencl/opencl_table.hpp"

namespace csgrt {

/// OpenCL's name of an error code, "CL_OUT_OF_RESOURCES"; "an unknown error" for a code of no known meaning.
const char* opencl_error_name(cl_int code) noexcept;

/// Throws "CALL failed: NAME (number)" unless `code` is CL_SUCCESS, with Status::out_of_memory if the code means a lack
/// of memory, else Status::device_fault. `call` names the call and its object: "clEnqueueReadBuffer (pixels)".
void check(cl_int code, std::string_view call);

/// The OpenCL functions for one device, and the time limit of waits for it.
struct Driver : OpenCl {
    Driver(const OpenCl& functions, std::string name, double seconds)
        : OpenCl(functions), table(&functions), device(std::move(name)), patience(seconds) {}

    /// Throws Error (device_fault) if the device is lost.
    void check_lost() const;
    /// Marks the device as lost: its driver is not called any more, because a call might wait for ever. Throws as
    /// check_lost() does.
    [[noreturn]] void give_up() const;

    const OpenCl* table;                       ///< the table that the functions were copied from
    std::string device;                        ///< the device's name
    double patience;                           ///< seconds that the host waits for an answer; 0: without a limit
    mutable std::atomic<bool> is_lost{false};  ///< set when an answer took longer, or after memory ran out
};

/// Keeps memory for ever, because a lost device may still read or write it.
void keep_for_ever(std::shared_ptr<const void> memory);

/// Owns one OpenCL object. The table's function `release` frees the object. If the device is lost, the object is not
/// freed, because its driver might wait. Freeing never throws.
template <class T, cl_int (*OpenCl::*release)(T)>
class Handle {
public:
    Handle() = default;
    Handle(const Driver& cl, T object) noexcept : cl_(&cl), object_(object) {}
    Handle(Handle&& other) noexcept : cl_(other.cl_), object_(std::exchange(other.object_, nullptr)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(cl_, other.cl_);
        std::swap(object_, other.object_);
        return *this;
    }
    ~Handle() {
        if (object_ && !cl_->is_lost) (cl_->*release)(object_);
    }

    T get() const noexcept { return object_; }
    const Driver& cl() const noexcept { return *cl_; }  ///< the driver of the object's device; not for an empty handle
    explicit operator bool() const noexcept { return object_ != nullptr; }

private:
    const Driver* cl_ = nullptr;
    T object_ = nullptr;
};

using Context = Handle<cl_context, &OpenCl::ReleaseContext>;
using Queue = Handle<cl_command_queue, &OpenCl::ReleaseCommandQueue>;
using Memory = Handle<cl_mem, &OpenCl::ReleaseMemObject>;

/// A command that was queued. Empty: there was nothing to do.
using Event = Handle<cl_event, &OpenCl::ReleaseEvent>;

/// Waits until the command is done; an empty event is done. Throws Error (device_fault, out_of_memory) if the command
/// failed. After the time limit, marks the device as lost and throws Error (device_fault). All other waits throw the
/// same errors.
void wait_for(const Event& event);
/// Waits by polling, and may return some ten microseconds late. A thread that waits within NVIDIA's driver would slow
/// threads that queue commands (measured: docs/experiments.md).
void wait_patiently(const Event& event);
/// Whether the command is done or has failed. A wait reports the failure.
bool is_done(const Event& event);
/// Waits by polling until one of several events of one device is_done().
void wait_for_one(std::span<const Event* const> events);
/// Waits until the command is done or has failed. If the device is not lost, memory that the command used may then be
/// freed.
void wait_until_done(const Event& event) noexcept;

/// Nanoseconds on a device's own clock, which all its queues share.
struct TimeSpan {
    std::uint64_t begin = 0, end = 0;
};

/// The time span when the device ran a command. Waits until the command is done. An empty event has length 0. Throws
/// Error (device_fault, out_of_memory) if the command failed.
TimeSpan time_span(const Event& event);

}  // namespace csgrt
