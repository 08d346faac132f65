// The memory of a picture that is drawn again and again, made known to the GPUs that draw it, which then copy into it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "device/buffer.hpp"
#include "pipeline/picture.hpp"

namespace csgrt {

class KnownPicture {
public:
    /// Makes `pixels` floats of each plane known to the device. False: its driver refuses.
    bool add(const Device& device, std::span<const ChannelPlane> planes, std::size_t pixels);

    bool is_known_to(const Device& device) const;

private:
    struct Entry {
        cl_context context;  ///< the memory holds on to it: no other comes to stand there
        std::vector<KnownMemory> planes;
    };
    std::vector<Entry> entries_;
};

}  // namespace csgrt
