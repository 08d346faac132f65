// The ground under src/device: OpenCL's handles freed by scope, its calls checked by name, its events timed.
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

/// Throws unless `code` is CL_SUCCESS: "CALL failed: NAME (number)" with Status::out_of_memory where the code says that
/// memory ran out, else Status::device_fault. `call` says which call, and for what: "clEnqueueReadBuffer (pixels)".
void check(cl_int code, std::string_view call);

/// The functions that drive a device, and how long it may take.
struct Driver : OpenCl {
    Driver(const OpenCl& functions, std::string name, double seconds)
        : OpenCl(functions), table(&functions), device(std::move(name)), patience(seconds) {}

    /// Throws Error (device_fault) if the device is lost.
    void check_lost() const;
    /// From now on it is, and nothing is asked of its driver any more, which might wait for ever. Throws as
    /// check_lost().
    [[noreturn]] void give_up() const;

    const OpenCl* table;                       ///< what this is a copy of
    std::string device;                        ///< its name
    double patience;                           ///< seconds that the host waits for an answer; 0: any time
    mutable std::atomic<bool> is_lost{false};  ///< it took longer, or memory ended in it
};

/// Keeps for ever what a lost device may still read or write.
void keep_for_ever(std::shared_ptr<const void> memory);

/// Owns one OpenCL object, which the table's function `release` frees, but not of a lost device: its driver might wait.
/// That never throws: what could be done about it?
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
    const Driver& cl() const noexcept { return *cl_; }  ///< that made it; not of an empty handle
    explicit operator bool() const noexcept { return object_ != nullptr; }

private:
    const Driver* cl_ = nullptr;
    T object_ = nullptr;
};

using Context = Handle<cl_context, &OpenCl::ReleaseContext>;
using Queue = Handle<cl_command_queue, &OpenCl::ReleaseCommandQueue>;
using Memory = Handle<cl_mem, &OpenCl::ReleaseMemObject>;

/// Something that the device was told to do. Empty: there was nothing to do.
using Event = Handle<cl_event, &OpenCl::ReleaseEvent>;

/// Waits until it is done; an empty event is. Throws Error (device_fault, out_of_memory) if the command failed, and
/// (device_fault) if the driver's patience ends before: then the device is lost. So do all waits.
void wait_for(const Event& event);
/// The same by looking at it now and then: a thread that waits within NVIDIA's driver slows others that queue commands
/// (measured: docs/experiments.md). May return some ten microseconds late.
void wait_patiently(const Event& event);
/// Whether it is done, or has failed, which a wait for it then tells.
bool is_done(const Event& event);
/// Waits as patiently until one of several is_done(), which are of one device.
void wait_for_one(std::span<const Event* const> events);
/// The same, whether it failed or not: the memory that it needs may go, if the device is not lost.
void wait_until_done(const Event& event) noexcept;

/// Nanoseconds on a device's own clock, which all its queues share.
struct TimeSpan {
    std::uint64_t begin = 0, end = 0;
};

/// When the device ran a command; waits until it is done. Of no length for an empty event.
/// Throws Error (device_fault, out_of_memory) if the command failed.
TimeSpan time_span(const Event& event);

}  // namespace csgrt
