// Devices that csgrt can compute on.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <csgrt/error.hpp>
#include <csgrt/settings.hpp>

namespace csgrt {

/// One device, as its driver describes it.
struct DeviceInfo {
    std::string name = {}, platform = {}, version = {}, driver = {};
    std::string type = {};             ///< "cpu", "gpu" or "accelerator".
    std::uint64_t memory = 0;          ///< Bytes of the device's memory.
    std::uint64_t max_allocation = 0;  ///< Largest number of bytes of one buffer.
    unsigned compute_units = 0;
    bool fp64 = false;  ///< Whether it computes in double precision.
};

/// Returns every device, in the order of the numbers in Settings::device: the devices of OpenCL, and the native devices
/// (platform "csgrt"), which are this machine's processors with kernels that csgrt contains. Empty if there is no
/// device. In a process that was forked after its parent had used a driver, only native devices are returned. Appends a
/// sentence to `notes`, if it is not null, for each driver that cannot be used. Any thread.
///
/// PoCL, an OpenCL driver for processors, fails or ends the process if it cannot write its cache: POCL_CACHE_DIR, else
/// XDG_CACHE_HOME/pocl/kcache, else HOME/.cache/pocl/kcache. The library does not change the environment. A program
/// without a home directory (a service, a container) sets POCL_CACHE_DIR before its first call of devices(),
/// prepare_devices() or Renderer and before it starts threads, as the command `csgrt` does.
CSGRT_API std::vector<DeviceInfo> devices(std::vector<std::string>* notes = nullptr);

/// Starts, on a thread of its own, the search for the devices that a Renderer with these settings will need, and
/// returns at once. A driver takes some 30 ms to start, so a program should call this function before it loads a scene.
/// The function does nothing if the settings need no driver (the reference, native devices, the default choice on a
/// machine without a GPU), or if an earlier call has searched. A Renderer calls the function before it compiles the
/// scene. Any thread.
CSGRT_API void prepare_devices(const Settings& settings = {});

}  // namespace csgrt
