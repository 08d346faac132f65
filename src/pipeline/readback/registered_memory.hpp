// The memory of a picture that is drawn again and again, registered with the GPUs that draw it, which then copy into it.
#pragma once

#include <cstddef>
#include <map>
#include <span>

#include "device/buffer.hpp"

namespace csgrt {

class KnownPicture {
public:
    /// Of `bytes`, which hold all its channels.
    KnownPicture(void* data, std::size_t bytes) : data_(data), bytes_(bytes) {}

    /// Registers it with a device. A driver may refuse: then the device's pixels come by other memory. Takes a tenth of a second a
    /// gigabyte.
    void make_known(const Device& device);
    bool is_known_to(const Device& device) const { return known_.contains(device.context()); }
    std::size_t bytes() const { return bytes_; }

private:
    void* data_;
    std::size_t bytes_;
    std::map<cl_context, KnownMemory> known_;  ///< what is known holds on to its context: no other comes to stand there
};

}  // namespace csgrt
