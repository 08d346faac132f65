// Which devices draw, and when: native ones need no driver and no compiler, and draw at once where another must be
// waited for.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "device/discovery.hpp"

namespace csgrt {

struct DevicePlan {
    std::vector<FoundDevice> first;  ///< draw from the first call on; empty: there is none, and the reference draws
    /// Finds those that take over once their kernels are compiled; none: `first` stay. It may load drivers: a thread's
    /// work. Null: nobody takes over.
    std::function<std::vector<FoundDevice>()> find_next;
    std::string next;        ///< the name of those that take over, so far as it is known
    bool is_default = true;  ///< nobody asked for these devices: what goes wrong with those that take over is no error
    std::vector<std::string> notes;  ///< why the reference draws, a sentence each
};

/// What `settings` mean: device, method and wait_for_device. Drivers are loaded where a device is named that is not
/// native, or no native one can draw. Throws Error (no_device) if a named device is not there, or none has the method.
DevicePlan plan_devices(const Settings& settings);

/// Whether a Renderer of these settings loads drivers.
bool may_use_drivers(const Settings& settings);

}  // namespace csgrt
