// The memory of a picture that is drawn again and again, registered with GPUs, which then copy pixels straight into it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>

#include "device/buffer.hpp"

namespace csgrt {

class RegisteredMemory {
public:
    /// All channels of a picture, `bytes` from `data` on. The memory must outlive this.
    RegisteredMemory(void* data, std::size_t bytes) : data_(data), bytes_(bytes) {}

    /// Registers the memory with a device, which takes a tenth of a second a gigabyte. A driver may refuse: then the
    /// device's pixels come by staging memory.
    void add(const Device& device);
    /// A device that does not answer may yet write there.
    bool has_lost() const {
        return std::ranges::any_of(registered_, [](const auto& entry) { return entry.second.is_lost(); });
    }
    bool has(const Device& device) const { return registered_.contains(device.context()); }

private:
    void* data_;
    std::size_t bytes_;
    std::map<cl_context, HostRegistration> registered_;  ///< each keeps its context, so that no other gets its address
};

}  // namespace csgrt
