// OpenCL for src/device: its handles are freed by scope, its calls checked by name, its events timed.
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

/// Throws unless `code` is CL_SUCCESS: "CALL failed: NAME (number)", with Status::out_of_memory if the code says that
/// memory ran out, else Status::device_fault. `call` names the call and its object: "clEnqueueReadBuffer (pixels)".
void check(cl_int code, std::string_view call);

/// The functions that drive a device, and the time limit of its answers.
struct Driver : OpenCl {
    Driver(const OpenCl& functions, std::string name, double seconds)
        : OpenCl(functions), table(&functions), device(std::move(name)), patience(seconds) {}

    /// Throws Error (device_fault) if the device is lost.
    void check_lost() const;
    /// Declares the device lost: nothing is asked of its driver any more, which might wait for ever. Throws as
    /// check_lost() does.
    [[noreturn]] void give_up() const;

    const OpenCl* table;                       ///< the table that this is a copy of
    std::string device;                        ///< its name
    double patience;                           ///< seconds that the host waits for an answer; 0: without a limit
    mutable std::atomic<bool> is_lost{false};  ///< it took longer, or its memory ran out
};

/// Keeps for ever memory that a lost device may still read or write.
void keep_for_ever(std::shared_ptr<const void> memory);

/// Owns one OpenCL object. The table's function `release` frees it, except if the device is lost: its driver might
/// wait. Freeing never throws, since nobody could react.
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
    const Driver& cl() const noexcept { return *cl_; }  ///< of the device that made it; not for an empty handle
    explicit operator bool() const noexcept { return object_ != nullptr; }

private:
    const Driver* cl_ = nullptr;
    T object_ = nullptr;
};

using Context = Handle<cl_context, &OpenCl::ReleaseContext>;
using Queue = Handle<cl_command_queue, &OpenCl::ReleaseCommandQueue>;
using Memory = Handle<cl_mem, &OpenCl::ReleaseMemObject>;

/// A command that the device was given. Empty: there was nothing to do.
using Event = Handle<cl_event, &OpenCl::ReleaseEvent>;

/// Waits until the command is done; an empty event is done. Throws Error (device_fault, out_of_memory) if the command
/// failed, and (device_fault) if the time limit ends before: then the device is lost. All other waits throw the same.
void wait_for(const Event& event);
/// Waits by polling: a thread that waits within NVIDIA's driver slows others that queue commands (measured:
/// docs/experiments.md). May return some ten microseconds late.
void wait_patiently(const Event& event);
/// Whether the command is done, or has failed, which a wait for it then reports.
bool is_done(const Event& event);
/// Waits by polling until one of several events of one device is_done().
void wait_for_one(std::span<const Event* const> events);
/// Waits until the command is done or has failed: the memory that it needs may then be freed, if the device is not
/// lost.
void wait_until_done(const Event& event) noexcept;

/// Nanoseconds on a device's own clock, which all its queues share.
struct TimeSpan {
    std::uint64_t begin = 0, end = 0;
};

/// The time when the device ran a command; waits until it is done. Of no length for an empty event. Throws Error
/// (device_fault, out_of_memory) if the command failed.
TimeSpan time_span(const Event& event);

}  // namespace csgrt
