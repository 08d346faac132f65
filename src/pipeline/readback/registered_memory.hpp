// Registered memory: a picture's memory that is registered with GPUs, which then copy pixels straight into it. It is
// for pictures that are drawn again and again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>

#include "device/buffer.hpp"

namespace csgrt {

/// The registrations of one picture's memory with the GPUs that draw into it. The destructor ends the registrations.
class RegisteredMemory {
public:
    /// Refers to all channels of a picture, `bytes` from `data` on. The memory must outlive the object.
    RegisteredMemory(void* data, std::size_t bytes) : data_(data), bytes_(bytes) {}

    /// Registers the memory with a device, which takes a tenth of a second a gigabyte. If the driver refuses, the
    /// device's pixels go through staging memory.
    void add(const Device& device);
    /// Whether a device that does not respond may still write into the memory.
    bool has_lost() const {
        return std::ranges::any_of(registered_, [](const auto& entry) { return entry.second.is_lost(); });
    }
    bool has(const Device& device) const { return registered_.contains(device.context()); }

private:
    void* data_;
    std::size_t bytes_;
    std::map<cl_context, HostRegistration> registered_;  ///< each keeps its context, so keys stay unique
};

}  // namespace csgrt
