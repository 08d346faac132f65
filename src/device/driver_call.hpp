// Calls of drivers, and the end of the process.
#pragma once

namespace csgrt {

/// While there is one, a driver may compile, or run what it compiled, on threads of its own: PoCL compiles a kernel
/// when it is first launched. exit() destroys what its compiler uses; so it waits for those that there are, half a
/// minute at most, and no other begins: what would begin waits for the end.
class DriverCall {
public:
    /// Not `used`: it is nothing.
    explicit DriverCall(bool used = true);
    DriverCall(const DriverCall&) = delete;
    DriverCall& operator=(const DriverCall&) = delete;
    ~DriverCall();

private:
    bool used_;
};

/// Has exit() do so. To be called when drivers are loaded: what is loaded later is destroyed before it waits.
void wait_for_driver_calls_at_exit();

}  // namespace csgrt
