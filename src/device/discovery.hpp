// Which devices there are.
#pragma once

#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

#include "device/opencl/opencl_table.hpp"

namespace csgrt {

struct FoundDevice {
    const OpenCl* cl;
    cl_device_id id;
    DeviceInfo info;
};

struct Discovery {
    std::vector<FoundDevice> devices;  ///< in the order of their numbers
    std::vector<std::string> notes;    ///< on drivers that cannot be used, a sentence each
    bool lacked_memory = false;        ///< it kept one from being used
};

/// Whether OpenCL's drivers are this process's to use: they serve the process that uses them first, and no child that
/// is forked later. Any thread.
bool has_drivers();

/// Every device of every platform, and the native ones: the best of them before all other processors. Any thread.
Discovery find_devices();

/// The native ones alone, the best first, for which no driver is loaded. Empty if this processor can run none, or csgrt
/// was built without their kernels. Any thread.
std::vector<FoundDevice> find_native_devices();

/// Whether it is worth it to load drivers in search of a GPU. `folder` is where the system has its devices: on Linux a
/// driver reaches a GPU through a file there; elsewhere that is not known, and the answer is yes. Any thread.
bool may_have_gpu(const std::string& folder = "/dev");

/// For tests where there is no GPU: until this is gone, all devices of a platform are taken for GPUs, of which none can
/// be used if they are broken. One at a time.
class PretendedGpu {
public:
    explicit PretendedGpu(std::string platform, bool are_broken = false);
    ~PretendedGpu();
    PretendedGpu(const PretendedGpu&) = delete;
    PretendedGpu& operator=(const PretendedGpu&) = delete;
};

/// Has its kernels from csgrt itself, those of the default method and no others.
bool is_native(const DeviceInfo& device);

bool is_pocl(const DeviceInfo& device);

/// What there is to know of each.
std::vector<DeviceInfo> infos_of(const std::vector<FoundDevice>& devices);

/// For tests: until this is gone, native devices are driven by these functions; null: there are no such devices. One at
/// a time.
class NativeTable {
public:
    explicit NativeTable(const OpenCl* functions);
    ~NativeTable();
    NativeTable(const NativeTable&) = delete;
    NativeTable& operator=(const NativeTable&) = delete;
};

}  // namespace csgrt
