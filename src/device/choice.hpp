// Choice: finds the devices that a setting names.
#pragma once

#include <string>
#include <vector>

#include "device/discovery.hpp"

namespace csgrt {

/// The kernels that settings need. `compiled_by_device`: the kernels of single precision or of a method other than the
/// default, which native devices do not have (is_native).
enum class Kernels { any, compiled_by_device };
Kernels kernels_for(const Settings& settings);

/// The index of the device that `choice` names (see Device). Throws Error (no_device) that lists the devices.
std::size_t choose_device(const std::vector<DeviceInfo>& devices, const std::string& choice,
                          Kernels kernels = Kernels::any);

/// The indices of all devices that `choice` names. "gpus" names all GPUs with double precision; commas separate several
/// choices. Throws as choose_device() does, and if a device is named twice.
std::vector<std::size_t> choose_devices(const std::vector<DeviceInfo>& devices, const std::string& choice,
                                        Kernels kernels = Kernels::any);

}  // namespace csgrt
