// Device plan: which devices draw, and when. Native devices need no driver and no compiler, and draw at once where
// another device is not ready yet.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "device/discovery.hpp"

namespace csgrt {

/// The devices of a Renderer: those that draw at once, and those that take over later.
struct DevicePlan {
    std::vector<FoundDevice> first;  ///< draw from the first call on; empty: there is none, and the reference draws
    /// Finds the devices that take over once their kernels are compiled; none: `first` stay. It may load drivers, so a
    /// thread calls it. Null: no device takes over.
    std::function<std::vector<FoundDevice>()> find_next;
    std::string next;                ///< the name of the devices that take over, as far as it is known
    bool is_default = true;          ///< the user named no device: a fault of the devices that take over is no error
    std::vector<std::string> notes;  ///< the reasons why the reference draws, a sentence each
};

/// Plans by `settings`: device, method and wait_for_device. Drivers are loaded if a named device is not native, or no
/// native device can draw. Throws Error (no_device) if a named device is missing, or none has the method.
DevicePlan plan_devices(const Settings& settings);

/// Whether a Renderer of these settings loads drivers.
bool may_use_drivers(const Settings& settings);

}  // namespace csgrt
