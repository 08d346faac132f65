// Which device is meant.
#pragma once

#include <string>
#include <vector>

#include "device/discovery.hpp"

namespace csgrt {

/// Whose kernels: any device's, or only those of a device that compiles them itself, as other methods than the
/// default need, and single precision (is_native).
enum class Kernels { any, compiled_by_device };
Kernels kernels_for(const Settings& settings);

/// The index of the device that `choice` means (see Device). Throws Error (no_device) that lists what there is.
std::size_t choose_device(const std::vector<DeviceInfo>& devices, const std::string& choice,
                          Kernels kernels = Kernels::any);

/// The same where `choice` may mean several: "gpus", all with double precision, or choices with commas between them.
/// None is there twice: that is an error, too.
std::vector<std::size_t> choose_devices(const std::vector<DeviceInfo>& devices, const std::string& choice,
                                        Kernels kernels = Kernels::any);

}  // namespace csgrt
