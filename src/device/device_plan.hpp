// Device plan: which devices draw, and when. Native devices need no driver and no compiler, so they draw while another
// device's kernels are still being compiled.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "device/discovery.hpp"

namespace csgrt {

/// The devices of a Renderer: devices that draw at once, and devices that take over later.
struct DevicePlan {
    std::vector<FoundDevice> first;  ///< draw from the first call on; empty: the reference draws
    /// Finds the devices that take over once their kernels are compiled. An empty result: `first` go on. The function
    /// may load drivers, so call it on a thread. Null: no device takes over.
    std::function<std::vector<FoundDevice>()> find_next;
    std::string next;                ///< the name of the devices that take over, if it is known
    bool is_default = true;          ///< the user named no device: a fault of the devices that take over is no error
    std::vector<std::string> notes;  ///< sentences that say why the reference draws
};

/// Plans by `settings`: device, method and wait_for_device. Drivers are loaded if a named device is not native, or no
/// native device can draw. Throws Error (no_device) if a named device is missing, or none has the method.
DevicePlan plan_devices(const Settings& settings);

/// Whether a Renderer of these settings loads drivers.
bool may_use_drivers(const Settings& settings);

}  // namespace csgrt
