// A device for tests of what a device compiles itself: other sources than csgrt's kernels, other methods, a GPU's way
// of bringing pixels to the host. The native device has none of that.
#pragma once

#include <cstdlib>
#include <string>

#include "device/choice.hpp"
#include "device/device.hpp"

namespace csgrt::test {

/// The one that CSGRT_DEVICE names, else the one that would be taken without native ones.
inline std::string compiling_device() {
    if (const char* choice = std::getenv("CSGRT_DEVICE")) return choice;
    return std::to_string(choose_device(devices(), "", Kernels::compiled_by_device));
}

/// Is that a processor, whose float arithmetic is the host's?
inline bool is_processor() {
    static const bool is = Device(compiling_device()).info().type == "cpu";
    return is;
}

}  // namespace csgrt::test
