// Which devices there are.
#pragma once

#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

#include "device/opencl_table.hpp"

namespace csgrt {

struct FoundDevice {
    const OpenCl* cl;
    cl_device_id id;
    DeviceInfo info;
};

struct Discovery {
    std::vector<FoundDevice> devices;  ///< in the order of their numbers
    std::vector<std::string> notes;    ///< on drivers that cannot be used, a sentence each
};

/// Every device of every platform, and the native ones: the best of them before all other processors. Any thread.
Discovery find_devices();

/// Has its kernels from csgrt itself, those of the default method and no others.
bool is_native(const DeviceInfo& device);

/// What there is to know of each.
std::vector<DeviceInfo> infos_of(const std::vector<FoundDevice>& devices);

}  // namespace csgrt
