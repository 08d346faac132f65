// Driver calls: keeps the process from ending while a thread is in a driver.
#pragma once

#include "base/process.hpp"

namespace csgrt {

/// Marks a call of a driver. During a call, a driver may compile or run code on its own threads; PoCL, for example,
/// compiles a kernel at its first launch. exit() destroys the objects that the compiler uses. So exit() waits for the
/// current calls, at most 30 s, and later calls do not begin.
class DriverCall {
public:
    /// Begins a call. Does nothing if not `used`. Throws Error (usage) after exit() was called: at once in the thread
    /// that called exit(), and after 3 s in other threads, because a destructor may wait for them.
    explicit DriverCall(bool used = true);
    DriverCall(const DriverCall&) = delete;
    DriverCall& operator=(const DriverCall&) = delete;
    ~DriverCall();

    /// Begins a destructor's call, without waiting.
    static DriverCall of_destructor(bool used) noexcept { return DriverCall(used, 0); }
    /// False for a destructor's call after exit(): then the destructor must call no driver, and not free memory that a
    /// driver may use.
    bool has_begun() const noexcept { return has_begun_; }

private:
    DriverCall(bool used, int) noexcept;

    bool used_, has_begun_ = true;
};

/// Deletes objects that this process made, within a DriverCall. Objects that drivers may use are not deleted while the
/// process ends.
struct DeleteInCall : DeleteOwn {
    bool used = true;
    template <class T>
    void operator()(T* object) const {
        const DriverCall call = DriverCall::of_destructor(used && process == process_number());
        if (call.has_begun()) DeleteOwn::operator()(object);
    }
};

/// Makes exit() wait for driver calls. Call it after drivers are loaded, because exit() destroys objects of libraries
/// that are loaded later before it waits.
void wait_for_driver_calls_at_exit();

}  // namespace csgrt
