// Which devices there are, and which one is meant.
#pragma once

#include <string>
#include <vector>

#include <CL/cl.h>

#include <csgrt/renderer.hpp>

namespace csgrt {

struct FoundDevice {
    cl_device_id id;
    DeviceInfo info;
};

/// Every device of every platform, in the order of their numbers; empty if there is none.
/// Throws Error (device_fault) if OpenCL answers with anything else than devices or their absence.
std::vector<FoundDevice> find_devices();

/// What there is to know of each.
std::vector<DeviceInfo> infos_of(const std::vector<FoundDevice>& devices);

/// The index of the device that `choice` means (see Device). Throws Error (no_device) that lists what there is.
std::size_t choose_device(const std::vector<DeviceInfo>& devices, const std::string& choice);

/// The same where `choice` may mean several: "gpus", all with double precision, or choices with commas between them.
/// None is there twice: that is an error, too.
std::vector<std::size_t> choose_devices(const std::vector<DeviceInfo>& devices, const std::string& choice);

}  // namespace csgrt
