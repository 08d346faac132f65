// Discovery: finds the devices.
#pragma once

#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

#include "device/opencl/opencl_table.hpp"

namespace csgrt {

/// A device, and the table of OpenCL functions that call its driver.
struct FoundDevice {
    const OpenCl* cl;
    cl_device_id id;
    DeviceInfo info;
};

/// The devices of this machine, and the faults of drivers that were found on the way.
struct Discovery {
    std::vector<FoundDevice> devices;  ///< in the order of their numbers
    std::vector<std::string> notes;    ///< sentences about drivers that cannot be used
    bool lacked_memory = false;        ///< a driver cannot be used for lack of memory
};

/// Whether this process may use OpenCL's drivers. A driver works only in the process that used it first, and in none of
/// its later forks. Any thread.
bool has_drivers();

/// Finds the devices of all platforms, and the native devices. The best native device stands before all other
/// processors. Any thread.
Discovery find_devices();

/// Finds only the native devices, the best first, without loading a driver. Empty if this processor cannot run any of
/// their kernels, or csgrt was built without them. Any thread.
std::vector<FoundDevice> find_native_devices();

/// Whether drivers are worth loading in search of a GPU. `folder`: the system's folder of devices. On Linux a driver
/// opens a GPU through a file there; elsewhere the answer is always yes. Any thread.
bool may_have_gpu(const std::string& folder = "/dev");

/// For tests without a GPU: while the object lives, all devices of one platform count as GPUs, or, if `broken`, cannot
/// be used. At most one object at a time.
class PretendedGpu {
public:
    explicit PretendedGpu(std::string platform, bool are_broken = false);
    ~PretendedGpu();
    PretendedGpu(const PretendedGpu&) = delete;
    PretendedGpu& operator=(const PretendedGpu&) = delete;
};

/// Whether the device runs kernels that csgrt was built with. These exist only for the default method.
bool is_native(const DeviceInfo& device);

bool is_pocl(const DeviceInfo& device);

/// The infos of all devices.
std::vector<DeviceInfo> infos_of(const std::vector<FoundDevice>& devices);

/// For tests: while the object lives, native devices use these functions. Null: there are no native devices. At most
/// one object at a time.
class NativeTable {
public:
    explicit NativeTable(const OpenCl* functions);
    ~NativeTable();
    NativeTable(const NativeTable&) = delete;
    NativeTable& operator=(const NativeTable&) = delete;
};

}  // namespace csgrt
