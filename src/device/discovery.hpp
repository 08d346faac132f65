// Discovery: finds the devices.
#pragma once

#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

#include "device/opencl/opencl_table.hpp"

namespace csgrt {

/// A device and the table of functions that drives it.
struct FoundDevice {
    const OpenCl* cl;
    cl_device_id id;
    DeviceInfo info;
};

/// The devices of this machine, and the faults of drivers that were found on the way.
struct Discovery {
    std::vector<FoundDevice> devices;  ///< in the order of their numbers
    std::vector<std::string> notes;    ///< on drivers that cannot be used, a sentence each
    bool lacked_memory = false;        ///< too little memory kept a driver from being used
};

/// Whether this process may use OpenCL's drivers: they serve the process that uses them first, and no child that it
/// forks later. Any thread.
bool has_drivers();

/// Finds every device of every platform, and the native ones: the best of these stands before all other processors. Any
/// thread.
Discovery find_devices();

/// Finds the native devices alone, the best first, without loading a driver. Empty if this processor can run none, or
/// csgrt was built without their kernels. Any thread.
std::vector<FoundDevice> find_native_devices();

/// Whether drivers are worth loading in search of a GPU. `folder`: the system's folder of devices. On Linux a driver
/// opens a GPU through a file there; elsewhere the answer is always yes. Any thread.
bool may_have_gpu(const std::string& folder = "/dev");

/// For tests without a GPU: while it lives, all devices of a platform are taken for GPUs; none of them can be used if
/// they are broken. One at a time.
class PretendedGpu {
public:
    explicit PretendedGpu(std::string platform, bool are_broken = false);
    ~PretendedGpu();
    PretendedGpu(const PretendedGpu&) = delete;
    PretendedGpu& operator=(const PretendedGpu&) = delete;
};

/// Whether the device has its kernels from csgrt itself: those of the default method and no others.
bool is_native(const DeviceInfo& device);

bool is_pocl(const DeviceInfo& device);

/// The infos of all devices.
std::vector<DeviceInfo> infos_of(const std::vector<FoundDevice>& devices);

/// For tests: while it lives, native devices are driven by these functions; null: there are no such devices. One at a
/// time.
class NativeTable {
public:
    explicit NativeTable(const OpenCl* functions);
    ~NativeTable();
    NativeTable(const NativeTable&) = delete;
    NativeTable& operator=(const NativeTable&) = delete;
};

}  // namespace csgrt
