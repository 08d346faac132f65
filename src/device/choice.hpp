// Choice of devices.
#pragma once

#include <string>
#include <vector>

#include "device/discovery.hpp"

namespace csgrt {

/// The kernels that a device needs: those of any device, or those that it compiles itself, as other methods than the
/// default and single precision need (is_native).
enum class Kernels { any, compiled_by_device };
Kernels kernels_for(const Settings& settings);

/// The index of the device that `choice` names (see Device). Throws Error (no_device) that lists the devices.
std::size_t choose_device(const std::vector<DeviceInfo>& devices, const std::string& choice,
                          Kernels kernels = Kernels::any);

/// The indices if `choice` may name several: "gpus", all with double precision, or choices with commas between them. It
/// is an error to name one twice.
std::vector<std::size_t> choose_devices(const std::vector<DeviceInfo>& devices, const std::string& choice,
                                        Kernels kernels = Kernels::any);

}  // namespace csgrt
