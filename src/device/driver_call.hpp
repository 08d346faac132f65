// Calls of drivers, and the end of the process.
#pragma once

#include "base/process.hpp"

namespace csgrt {

/// While there is one, a driver may compile, or run what it compiled, on threads of its own: PoCL compiles a kernel
/// when it is first launched. exit() destroys what its compiler uses; so it waits for those that there are, half a
/// minute at most, and no other begins: what would begin waits for the end.
class DriverCall {
public:
    /// Not `used`: it is nothing. Throws Error (usage) where nobody may wait for the end: in the thread that called
    /// exit(), and in any other after 3 s, since a destructor may wait for that thread.
    explicit DriverCall(bool used = true);
    DriverCall(const DriverCall&) = delete;
    DriverCall& operator=(const DriverCall&) = delete;
    ~DriverCall();

    /// A destructor's, which does not wait.
    static DriverCall of_destructor(bool used) noexcept { return DriverCall(used, 0); }
    /// False of a destructor's that comes after exit(): it calls no driver, and what a driver may know stays.
    bool has_begun() const noexcept { return has_begun_; }

private:
    DriverCall(bool used, int) noexcept;

    bool used_, has_begun_ = true;
};

/// Deletes what this process made in a DriverCall, if drivers may use it and the process does not end.
struct DeleteInCall : DeleteOwn {
    bool used = true;
    template <class T>
    void operator()(T* object) const {
        const DriverCall call = DriverCall::of_destructor(used && process == process_number());
        if (call.has_begun()) DeleteOwn::operator()(object);
    }
};

/// Has exit() do so. To be called when drivers are loaded: what is loaded later is destroyed before it waits.
void wait_for_driver_calls_at_exit();

}  // namespace csgrt
