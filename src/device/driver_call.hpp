// Driver calls, and the end of the process.
#pragma once

#include "base/process.hpp"

namespace csgrt {

/// Marks a call of a driver. While there is one, a driver may compile, or run compiled code, on threads of its own:
/// PoCL compiles a kernel when it is first launched. exit() destroys the objects that its compiler uses. So exit()
/// waits for the calls that there are, half a minute at most, and no other begins: a new call waits for the end.
class DriverCall {
public:
    /// Begins a call. If not `used`, it does nothing. Throws Error (usage) in a thread that must not wait for the end:
    /// the thread that called exit(); any other thread after 3 s, since a destructor may wait for it.
    explicit DriverCall(bool used = true);
    DriverCall(const DriverCall&) = delete;
    DriverCall& operator=(const DriverCall&) = delete;
    ~DriverCall();

    /// The call of a destructor, which does not wait.
    static DriverCall of_destructor(bool used) noexcept { return DriverCall(used, 0); }
    /// False for a destructor's call after exit(): then no driver is called, and memory that a driver may know stays.
    bool has_begun() const noexcept { return has_begun_; }

private:
    DriverCall(bool used, int) noexcept;

    bool used_, has_begun_ = true;
};

/// Deletes objects that this process made in a DriverCall, if drivers may use them and the process does not end.
struct DeleteInCall : DeleteOwn {
    bool used = true;
    template <class T>
    void operator()(T* object) const {
        const DriverCall call = DriverCall::of_destructor(used && process == process_number());
        if (call.has_begun()) DeleteOwn::operator()(object);
    }
};

/// Makes exit() wait. It must be called when drivers are loaded: objects that are loaded later are destroyed before the
/// wait.
void wait_for_driver_calls_at_exit();

}  // namespace csgrt
